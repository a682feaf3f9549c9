//! A place in a file, with the line that stands there: what an error points at.

use core::fmt;
use core::ops::Range;

/// A span of text on one line of a file.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Location {
    /// The file's name, as it was given with its text; `moment_shadows/<folder>/<file>.wgsl` for modules of the library.
    pub file: String,
    /// The line, from 1.
    pub line: u32,
    /// The column in characters, from 1.
    pub column: u32,
    /// How many characters the span covers on this line, at least 1.
    pub width: u32,
    /// The whole line, without its end. Control characters other than tabs are replaced, so it can be printed.
    pub text: String,
    /// What is there, for an error; may be empty.
    pub label: String,
}

impl Location {
    /// The first line of the bytes `range` of `text`. A range beyond the text counts as the text's end.
    pub(crate) fn in_text(file: &str, text: &str, range: Range<usize>) -> Self {
        let before = text.get(..range.start).unwrap_or(text);
        let line_start = before.rfind('\n').map_or(0, |end| end + 1);
        let from_line_start = text.get(line_start..).unwrap_or_default();
        let line = from_line_start.lines().next().unwrap_or_default();
        let covered = text
            .get(range)
            .and_then(|span| span.lines().next())
            .unwrap_or_default();
        let number = |count: usize| u32::try_from(count).unwrap_or(u32::MAX);
        let printable = |c: char| {
            let kept = !c.is_control() || c == '\t';
            if kept { c } else { char::REPLACEMENT_CHARACTER }
        };
        let before_span = before.get(line_start..).unwrap_or_default();
        Self {
            file: file.to_owned(),
            line: number(before.matches('\n').count()).saturating_add(1),
            column: number(before_span.chars().count()).saturating_add(1),
            width: number(covered.chars().count()).max(1),
            text: line.chars().map(printable).collect(),
            label: String::new(),
        }
    }

    /// The place with a label.
    pub(crate) fn labelled(mut self, label: &str) -> Self {
        label.clone_into(&mut self.label);
        self
    }
}

/// The place, the line, and a line with carets and the label.
impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = self.line.to_string();
        let margin = " ".repeat(number.len());
        // Tabs stay tabs, so that the carets stand under the span in any terminal.
        let indent: String = self
            .text
            .chars()
            .take(self.column.saturating_sub(1) as usize)
            .map(|c| if c == '\t' { '\t' } else { ' ' })
            .collect();
        let carets = "^".repeat(self.width as usize);
        let marked = format!("{margin} | {indent}{carets} {}", self.label);
        let (file, column) = (&self.file, self.column);
        writeln!(f, "{margin}--> {file}:{number}:{column}")?;
        writeln!(f, "{margin} |\n{number} | {}", self.text)?;
        f.write_str(marked.trim_end())
    }
}
