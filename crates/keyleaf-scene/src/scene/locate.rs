//! Where the fields of a scene stand in its text.
//!
//! RON gives the position of an error but not its field, and no position at all for a value that is of the right type
//! but out of range. This walks over the text once and notes where each field begins and ends. It accepts anything:
//! what it does not understand it skips.

/// Line and column, both from 1, in characters.
pub(super) type Position = (usize, usize);

/// A value in the text.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Field {
    /// Such as `paths[0].keys[1].eye`.
    pub path: String,
    /// Where its name begins (for a list element: where its value begins).
    pub key: Position,
    /// Where its value begins.
    pub start: Position,
    /// Where its value ends.
    pub end: Position,
    /// Whether its value has named fields, or none at all.
    pub is_struct: bool,
}

impl Field {
    /// The last part of the path, without an index.
    pub fn name(&self) -> &str {
        self.path.rsplit('.').next().unwrap_or("")
    }

    /// The path of what it stands in.
    pub fn parent(&self) -> String {
        self.path
            .rfind(['.', '['])
            .map_or(String::new(), |end| self.path[..end].to_owned())
    }
}

/// ` in <field>: ` for an error message, or nothing.
pub(super) fn prefix(field: &str) -> String {
    if field.is_empty() {
        String::new()
    } else {
        format!("{field}: ")
    }
}

/// `line:column:` for an error message, or nothing.
pub(super) fn position(line: &Option<usize>, column: &Option<usize>) -> String {
    match (line, column) {
        (Some(line), Some(column)) => format!("{line}:{column}:"),
        _ => String::new(),
    }
}

/// Deeper than any scene, so that hostile text does not exhaust the stack.
const MAX_DEPTH: usize = 64;

/// All fields of a text, in the order in which their values end.
pub(super) fn fields(text: &str) -> Vec<Field> {
    let mut walker = Walker {
        rest: text.chars().collect(),
        at: 0,
        position: (1, 1),
        fields: Vec::new(),
    };
    walker.skip_space();
    // An attribute such as #![enable(implicit_some)].
    while walker.peek() == Some('#') {
        while walker.peek().is_some_and(|c| c != '\n') {
            walker.next();
        }
        walker.skip_space();
    }
    let start = walker.position;
    walker.value("", start, 0);
    walker.fields
}

struct Walker {
    rest: Vec<char>,
    at: usize,
    position: Position,
    fields: Vec<Field>,
}

impl Walker {
    fn peek(&self) -> Option<char> {
        self.rest.get(self.at).copied()
    }

    fn peek_second(&self) -> Option<char> {
        self.rest.get(self.at + 1).copied()
    }

    fn next(&mut self) -> Option<char> {
        let c = self.peek()?;
        self.at += 1;
        self.position = if c == '\n' {
            (self.position.0 + 1, 1)
        } else {
            (self.position.0, self.position.1 + 1)
        };
        Some(c)
    }

    /// Skips white space and comments.
    fn skip_space(&mut self) {
        loop {
            match (self.peek(), self.peek_second()) {
                (Some(c), _) if c.is_whitespace() => {
                    self.next();
                }
                (Some('/'), Some('/')) => while self.next().is_some_and(|c| c != '\n') {},
                (Some('/'), Some('*')) => self.skip_block_comment(),
                _ => return,
            }
        }
    }

    fn skip_block_comment(&mut self) {
        let mut depth = 0;
        loop {
            match (self.peek(), self.peek_second()) {
                (Some('/'), Some('*')) => depth += 1,
                (Some('*'), Some('/')) => depth -= 1,
                (None, _) => return,
                _ => {
                    self.next();
                    continue;
                }
            }
            self.next();
            self.next();
            if depth == 0 {
                return;
            }
        }
    }

    fn word(&mut self) -> String {
        let mut word = String::new();
        while let Some(c) = self
            .peek()
            .filter(|c| c.is_alphanumeric() || matches!(c, '_' | '.' | '+' | '-'))
        {
            word.push(c);
            self.next();
        }
        word
    }

    fn string(&mut self) {
        self.next();
        while let Some(c) = self.next() {
            match c {
                '\\' => {
                    self.next();
                }
                '"' => return,
                _ => {}
            }
        }
    }

    /// A raw string, from its hashes on.
    fn raw_string(&mut self) {
        let mut hashes = 0;
        while self.peek() == Some('#') {
            self.next();
            hashes += 1;
        }
        if self.peek() != Some('"') {
            return;
        }
        self.next();
        while let Some(c) = self.next() {
            if c == '"' && self.rest[self.at..].iter().take(hashes).filter(|&&h| h == '#').count() == hashes {
                (0..hashes).for_each(|_| {
                    self.next();
                });
                return;
            }
        }
    }

    /// One value with the given path, whose name begins at `key`.
    fn value(&mut self, path: &str, key: Position, depth: usize) {
        self.skip_space();
        let start = self.position;
        let is_struct = self.inner_value(path, depth);
        let field = Field {
            path: path.to_owned(),
            key,
            start,
            end: self.position,
            is_struct,
        };
        self.fields.push(field);
    }

    /// The value itself; says whether it is a struct.
    fn inner_value(&mut self, path: &str, depth: usize) -> bool {
        if depth > MAX_DEPTH {
            self.at = self.rest.len();
            return false;
        }
        match self.peek() {
            Some('"') => {
                self.string();
                return false;
            }
            Some('[') => {
                self.list(path, depth);
                return false;
            }
            Some('\'') => {
                (0..3).for_each(|_| {
                    self.next();
                });
                return false;
            }
            _ => {}
        }
        let word = self.word();
        if word == "r" && matches!(self.peek(), Some('#' | '"')) {
            self.raw_string();
            return false;
        }
        self.skip_space();
        if self.peek() == Some('(') {
            self.group(path, depth)
        } else {
            false
        }
    }

    fn list(&mut self, path: &str, depth: usize) {
        self.next();
        for index in 0.. {
            self.skip_space();
            match self.peek() {
                // The wrong bracket ends the list too, for what is around it.
                None | Some(')') => return,
                Some(']') => {
                    self.next();
                    return;
                }
                _ => {
                    let key = self.position;
                    self.value(&format!("{path}[{index}]"), key, depth + 1);
                    self.separator();
                }
            }
        }
    }

    /// What stands in parentheses: named fields, or values without names, which keep the path.
    fn group(&mut self, path: &str, depth: usize) -> bool {
        self.next();
        let mut named = false;
        let mut first = true;
        loop {
            self.skip_space();
            let key = self.position;
            match self.peek() {
                None | Some(']') => return named,
                Some(')') => {
                    self.next();
                    return named || first;
                }
                _ => {}
            }
            first = false;
            let mark = (self.at, self.position);
            let word = self.word();
            self.skip_space();
            if !word.is_empty() && self.peek() == Some(':') {
                named = true;
                self.next();
                let separator = if path.is_empty() { "" } else { "." };
                self.value(&format!("{path}{separator}{word}"), key, depth + 1);
            } else {
                (self.at, self.position) = mark;
                self.skip_space();
                named |= self.inner_value(path, depth + 1);
            }
            self.separator();
        }
    }

    /// A comma, or whatever stands where one should: always goes on.
    fn separator(&mut self) {
        self.skip_space();
        if !matches!(self.peek(), None | Some(')' | ']')) {
            self.next();
        }
    }
}
