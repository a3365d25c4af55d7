//! Where a compiler's complaint about a composed module belongs.

use crate::compose;

/// Joins the files of a module in its label.
pub const JOIN: &str = " + ";

/// The label of a module of these files, by which [`located`] knows it.
pub fn label(roots: &[&str]) -> String {
    roots.join(JOIN)
}

/// A compiler's message with the files and their lines in place of those of the composed module. The module's label is that of
/// [`label`]; a message that names no such module stays.
///
/// The format is that of naga: `┌─ name:line:column`, with numbered lines of the source below.
pub fn located(message: &str) -> String {
    let Some(module) = labels(message).find_map(|label| compose(&label.split(JOIN).collect::<Vec<_>>()).ok()) else {
        return message.to_owned();
    };
    let mut text: String = message
        .lines()
        .map(|line| with_place(line, &module).unwrap_or_else(|| line.to_owned()) + "\n")
        .collect();
    if !message.ends_with('\n') {
        text.pop();
    }
    text
}

/// What may be a label: names in quotes, and those of places.
fn labels(message: &str) -> impl Iterator<Item = &str> {
    let quoted = message.lines().flat_map(|line| line.split('\'').skip(1).step_by(2));
    let places = message.lines().filter_map(|line| Some(place(line)?.0));
    quoted.chain(places).filter(|label| label.ends_with(".wgsl"))
}

/// Name, line and column of `┌─ name:line:column`.
fn place(line: &str) -> Option<(&str, usize, &str)> {
    let mut parts = line.trim_start().strip_prefix("┌─ ")?.rsplitn(3, ':');
    let (column, number, name) = (parts.next()?, parts.next()?, parts.next()?);
    Some((name, number.parse().ok()?, column))
}

/// The same line with another place or number, if it has one.
fn with_place(line: &str, module: &str) -> Option<String> {
    let indent = &line[..line.len() - line.trim_start().len()];
    if let Some((_, number, column)) = place(line) {
        let (file, number) = line_of(module, number)?;
        return Some(format!("{indent}┌─ {file}:{number}:{column}"));
    }
    let (number, rest) = line.split_once('│')?;
    let (_, own) = line_of(module, number.trim().parse().ok()?)?;
    let width = number.trim_end().chars().count();
    Some(format!("{own:>width$} │{rest}"))
}

/// File and line, from 1, of a line of a composed module.
fn line_of(module: &str, number: usize) -> Option<(&str, usize)> {
    let lines = (1..=number).zip(module.lines());
    let headings = lines.filter_map(|(at, line)| Some((at, line.strip_prefix("// ---- ")?)));
    let (heading, file) = headings.last()?;
    Some((file, (number - heading).max(1)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source;

    /// Line, from 1, of a text in a composed module and in its file.
    fn lines_of(roots: &[&str], file: &str, text: &str) -> (usize, usize) {
        let line = |source: &str| 1 + source.lines().position(|line| line.contains(text)).unwrap();
        (line(&compose(roots).unwrap()), line(source(file).unwrap()))
    }

    #[test]
    fn complaints_name_the_file_and_its_line() {
        let roots = ["passes/update.wgsl", "surfaces/mesh.wgsl", "metrics/edge.wgsl"];
        let name = label(&roots);
        let (whole, own) = lines_of(&roots, "metrics/edge.wgsl", "fn metric_size");
        assert!(whole > own);
        let text = "fn metric_size(leaf: Place)";
        let gutter = |number: usize| format!("{number:>4} │ {text}");
        let parsed = format!(
            "In Device::create_shader_module, label = '{name}'\n\nShader '{name}' parsing error: expected\n     ┌─ wgsl:{whole}:4\n     \
             │\n{}\n     │    ^^^\n",
            gutter(whole)
        );
        let found = located(&parsed);
        assert!(
            found.contains(&format!("     ┌─ metrics/edge.wgsl:{own}:4\n")),
            "{found}"
        );
        assert!(found.contains(&gutter(own)) && found.ends_with("^^^\n"), "{found}");
        let validated = format!("Shader validation error: type\n     ┌─ {name}:{whole}:4");
        assert!(located(&validated).ends_with(&format!("┌─ metrics/edge.wgsl:{own}:4")));
        for other in ["Buffer 'x' is too large", "Shader 'own' parsing error\n  ┌─ wgsl:1:2\n"] {
            assert_eq!(located(other), other);
        }
    }
}
