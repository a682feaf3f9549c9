//! Names through naga's writers, which number what is named alike in different functions.

use std::collections::{BTreeMap, BTreeSet};

use naga::Module;

/// What stands for a name: naga leaves it as it is, and no other text holds it.
const START: &str = "xq";
const END: &str = "qx";

/// The names of a module, each by the number of what stands for it.
#[derive(Default)]
pub(super) struct Names {
    all: Vec<String>,
}

impl Names {
    fn stand_in(&mut self, name: &str) -> String {
        self.all.push(name.to_owned());
        format!("{START}{}{END}", self.all.len() - 1)
    }

    /// Names everything in the module by what stands for its name. Of two variables of one name in a function one gets a number.
    pub(super) fn replace(&mut self, module: &mut Module) {
        let types: Vec<_> = module
            .types
            .iter()
            .map(|(handle, ty)| (handle, ty.clone()))
            .collect();
        for (handle, mut ty) in types {
            if let Some(name) = ty.name.take() {
                ty.name = Some(self.stand_in(&name));
                module.types.replace(handle, ty);
            }
        }
        for (_, constant) in module.constants.iter_mut() {
            constant.name = constant.name.take().map(|name| self.stand_in(&name));
        }
        for (_, function) in module.functions.iter_mut() {
            function.name = function.name.take().map(|name| self.stand_in(&name));
        }
        let global: BTreeSet<String> = self.all.iter().cloned().collect();
        for (_, function) in module.functions.iter_mut() {
            let mut taken = global.clone();
            let mut local = |name: &mut String| {
                let mut own = name.clone();
                for number in 2.. {
                    if taken.insert(own.clone()) {
                        break;
                    }
                    own = format!("{name}_{number}");
                }
                *name = self.stand_in(&own);
            };
            let arguments = function.arguments.iter_mut();
            arguments
                .filter_map(|it| it.name.as_mut())
                .for_each(&mut local);
            let variables = function.local_variables.iter_mut();
            variables
                .filter_map(|(_, it)| it.name.as_mut())
                .for_each(&mut local);
            function.named_expressions.values_mut().for_each(&mut local);
        }
    }

    /// All of them, each once.
    pub(super) fn distinct(&self) -> BTreeSet<&str> {
        self.all.iter().map(String::as_str).collect()
    }

    /// A text of the module with the names in it, and `comments` above the definitions of some. Names that are `reserved` get an
    /// underscore.
    pub(super) fn restored(
        &self,
        text: &str,
        reserved: &[String],
        comments: &BTreeMap<String, String>,
    ) -> String {
        let mut restored = String::with_capacity(text.len());
        let mut of = None;
        for line in text.split_inclusive('\n') {
            let defined = self.defined(line);
            of = match (defined, member(line)) {
                (Some(_), _) if line.starts_with("struct ") => defined,
                (None, Some(member)) => {
                    let comment = of.and_then(|of| comments.get(&format!("{of}.{member}")));
                    restored.push_str(comment.map_or("", String::as_str));
                    of
                }
                _ => None,
            };
            if let Some(comment) = defined.and_then(|name| comments.get(name)) {
                if !restored.ends_with("\n\n") {
                    restored.push('\n');
                }
                restored.push_str(comment);
            }
            let mut rest = line;
            while let Some((before, name, after)) = self.next(rest) {
                restored.push_str(before);
                restored.push_str(name);
                if reserved.iter().any(|it| it == name) {
                    restored.push('_');
                }
                rest = after;
            }
            restored.push_str(rest);
        }
        restored
    }

    /// What a line without an indent defines: the last name before its parameters, value or members. Helpers of the writer are no definitions.
    fn defined<'a>(&'a self, line: &'a str) -> Option<&'a str> {
        if line.starts_with([' ', '}', '#', '/'])
            || line.contains("Construct") && !line.starts_with("static const")
        {
            return None;
        }
        let head = line.split(['(', '=', '{', ';']).next()?;
        let mut rest = head;
        let mut last = None;
        while let Some((_, name, after)) = self.next(rest) {
            last = Some(name);
            rest = after;
        }
        last
    }

    /// The next name in a text, with what is before and behind.
    fn next<'a>(&'a self, text: &'a str) -> Option<(&'a str, &'a str, &'a str)> {
        let mut from = 0;
        loop {
            let start = from + text.get(from..)?.find(START)?;
            let digits = text.get(start + START.len()..)?;
            let end = digits
                .find(|c: char| !c.is_ascii_digit())
                .unwrap_or(digits.len());
            let (number, after) = digits.split_at(end);
            if let Some(after) = after.strip_prefix(END)
                && let Some(name) = number.parse().ok().and_then(|it: usize| self.all.get(it))
            {
                return Some((text.get(..start)?, name, after));
            }
            from = start + START.len();
        }
    }
}

/// The member that a line of a struct defines.
fn member(line: &str) -> Option<&str> {
    let definition = line.strip_prefix("    ")?.trim_end().strip_suffix(';')?;
    let definition = definition.split('[').next()?;
    definition.rsplit(' ').next()
}
