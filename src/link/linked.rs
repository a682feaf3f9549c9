//! The linker's result: one WGSL text, and where each of its lines comes from.

use core::ops::Range;

use super::file::File;
use super::prune::gaps;
use crate::Location;

/// A linked WGSL text that knows where each of its lines comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Linked {
    wgsl: String,
    files: Vec<String>,
    /// For each line of the text, the file's index and the line there, from 1; none for the comments that name files.
    lines: Vec<Option<(usize, u32)>>,
}

impl Linked {
    /// The linked text: plain WGSL.
    #[must_use]
    pub fn wgsl(&self) -> &str {
        &self.wgsl
    }

    /// The linked text, without a copy.
    #[must_use]
    pub fn into_wgsl(self) -> String {
        self.wgsl
    }

    /// The files of which anything was linked, in the order of the text; the file given to the linker is the last.
    pub fn files(&self) -> impl ExactSizeIterator<Item = &str> {
        self.files.iter().map(String::as_str)
    }

    /// The file and the line, both lines from 1, that the line `line` of the text comes from. None for the comments that name
    /// files, and beyond the text.
    #[must_use]
    pub fn origin(&self, line: u32) -> Option<(&str, u32)> {
        let index = usize::try_from(line).ok()?.checked_sub(1)?;
        let (file, line) = (*self.lines.get(index)?)?;
        Some((self.files.get(file)?, line))
    }

    /// Where the bytes `range` of the text come from. Columns are those of the text: lines are linked unchanged.
    #[must_use]
    pub fn location(&self, range: Range<usize>) -> Option<Location> {
        let mut location = Location::in_text("", &self.wgsl, range);
        // The end of the text is the end of its last line.
        let last = self.origin(location.line).is_none() && location.text.is_empty();
        let (file, line) = self.origin(location.line - u32::from(last))?;
        location.file = file.to_owned();
        location.line = line;
        Some(location)
    }

    /// Another text with the same lines, but for what stands in some.
    #[cfg(feature = "validate")]
    pub(crate) fn with_text(&self, wgsl: String) -> Self {
        Self {
            wgsl,
            ..self.clone()
        }
    }

    /// Joins `files`, the last of which is the one that was given to the linker.
    pub(crate) fn join(files: &[File<'_>]) -> Self {
        let mut linked = Self {
            wgsl: String::new(),
            files: files.iter().map(|file| file.name.clone()).collect(),
            lines: Vec::new(),
        };
        if let Some((index, root)) = files.iter().enumerate().next_back() {
            let others = gaps(root.directives(), root.text.len());
            let directives = without(root.text, &others);
            for (line, text) in (1..).zip(directives.lines()) {
                if !text.trim().is_empty() {
                    linked.push_line(text.trim_end(), Some((index, line)));
                }
            }
        }
        for (index, file) in files.iter().enumerate() {
            linked.push_file(index, file, index + 1 == files.len());
        }
        linked
    }

    fn push_file(&mut self, index: usize, file: &File<'_>, is_root: bool) {
        if !self.lines.is_empty() {
            self.push_line("", None);
        }
        // A line break in a name would end the comment.
        let is_break = |c: char| c.is_control() || matches!(c, '\u{2028}' | '\u{2029}');
        let name = file.name.replace(is_break, "");
        self.push_line(&format!("// {name}"), None);

        let text = without(file.text, &file.left_out);
        // Of several blank lines in succession one is kept, and none at the ends of a part.
        let mut blank = !is_root;
        for (line, (original, text)) in (1..).zip(file.text.lines().zip(text.lines())) {
            let is_blank = text.trim().is_empty();
            if is_blank && (blank || !original.trim().is_empty()) {
                continue;
            }
            blank = is_blank;
            self.push_line(if blank { "" } else { text }, Some((index, line)));
        }
        if !is_root && self.wgsl.ends_with("\n\n") {
            self.wgsl.pop();
            self.lines.pop();
        }
    }

    fn push_line(&mut self, text: &str, origin: Option<(usize, u32)>) {
        self.wgsl.push_str(text);
        self.wgsl.push('\n');
        self.lines.push(origin);
    }
}

/// `text` with spaces for every character in `ranges`, which are in order. Lines and columns stay.
fn without(text: &str, ranges: &[Range<usize>]) -> String {
    let part = |range: Range<usize>| text.get(range).unwrap_or_default();
    let blank = |c: char| if matches!(c, '\n' | '\r') { c } else { ' ' };
    let mut kept = String::with_capacity(text.len());
    let mut done = 0;
    for range in ranges {
        kept.push_str(part(done..range.start));
        kept.extend(part(range.clone()).chars().map(blank));
        done = range.end;
    }
    kept.push_str(part(done..text.len()));
    kept
}
