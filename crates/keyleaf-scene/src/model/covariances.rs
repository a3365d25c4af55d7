//! Covariance files (`.cov`): the shape of the Gaussian at each vertex of a control mesh, beside a model of any format.

use std::path::Path;

use crate::error::{FilePlace, ImportError, read_file};
use crate::soup::check_finite;

/// Numbers that state the same entry may differ by this part of the largest entry: what rounding to some digits leaves.
const SYMMETRY: f64 = 1e-6;

/// Reads a `.cov` file for a model with this many vertices: xx, xy, xz, yy, yz, zz of each, in squares of the model's unit.
///
/// ```text
/// # comment, anywhere
/// covariances 8                           the keyword, and how many vertices there are
/// 0.04 0 0  0.04 0  0.0001                xx xy xz yy yz zz, a vertex a line, in the order of the model's vertices
/// 0.04 0 0  0 0.04 0  0 0 0.0001          or all nine numbers of the symmetric matrix, row by row
/// ```
///
/// The vertices of OBJ, PLY and OFF files count as they stand in the file, those of STL and glTF files in the order in which their
/// positions first appear. That matrices are positive definite is not checked here.
///
/// # Errors
/// [`ImportError`] with file and line: a malformed line, a matrix that is not symmetric, a number that is not finite, another number of
/// vertices.
pub fn read_covariances(file: &Path, vertices: usize) -> Result<Vec<[f64; 6]>, ImportError> {
    parse(file, &String::from_utf8_lossy(&read_file(file)?), vertices)
}

fn parse(file: &Path, text: &str, vertices: usize) -> Result<Vec<[f64; 6]>, ImportError> {
    let mut lines = text
        .lines()
        .zip(1..)
        .map(|(line, number)| (number, line.split('#').next().unwrap_or("").trim()))
        .filter(|(_, line)| !line.is_empty());
    let (number, header) = lines.next().unwrap_or((1, ""));
    let malformed = |line: usize, reason: String| ImportError::malformed(file, FilePlace::Line(line), reason);
    let count = match header.split_ascii_whitespace().collect::<Vec<_>>()[..] {
        ["covariances", count] => count.parse::<usize>().ok(),
        _ => None,
    };
    let Some(count) = count else {
        let reason = format!("expected the header 'covariances' and the number of vertices, found '{header}'");
        return Err(malformed(number, reason));
    };
    if count != vertices {
        let reason = format!("the header says {count} vertices, the model has {vertices}");
        return Err(malformed(number, reason));
    }
    let mut covariances = Vec::new();
    let mut last = number;
    for (number, line) in lines {
        last = number;
        if covariances.len() == vertices {
            let reason = format!("a covariance more than the {vertices} that the header says");
            return Err(malformed(number, reason));
        }
        covariances.push(covariance(file, number, line)?);
    }
    if covariances.len() < vertices {
        let reason = format!("the file ends after {} of {vertices} covariances", covariances.len());
        return Err(malformed(last, reason));
    }
    Ok(covariances)
}

fn covariance(file: &Path, number: usize, line: &str) -> Result<[f64; 6], ImportError> {
    let malformed = |reason: String| ImportError::malformed(file, FilePlace::Line(number), reason);
    let mut values = Vec::with_capacity(9);
    for word in line.split_ascii_whitespace() {
        let value: f64 = word.parse().map_err(|_| malformed(format!("'{word}' is no number")))?;
        values.push(value);
    }
    check_finite(file, || FilePlace::Line(number), "covariance", &values)?;
    if let [xx, xy, xz, yy, yz, zz] = values[..] {
        return Ok([xx, xy, xz, yy, yz, zz]);
    }
    let [xx, xy, xz, yx, yy, yz, zx, zy, zz] = values[..] else {
        let reason = format!(
            "a covariance has 6 numbers, xx xy xz yy yz zz, or all 9; this one has {}",
            values.len()
        );
        return Err(malformed(reason));
    };
    let largest = values.iter().fold(0.0f64, |most, v| most.max(v.abs()));
    for (name, turned, a, b) in [("xy", "yx", xy, yx), ("xz", "zx", xz, zx), ("yz", "zy", yz, zy)] {
        if (a - b).abs() > SYMMETRY * largest {
            let reason = format!("the matrix is not symmetric: {name} is {a}, {turned} is {b}");
            return Err(malformed(reason));
        }
    }
    Ok([xx, (xy + yx) / 2.0, (xz + zx) / 2.0, yy, (yz + zy) / 2.0, zz])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, vertices: usize) -> Result<Vec<[f64; 6]>, String> {
        parse(Path::new("a.cov"), text, vertices).map_err(|e| e.to_string())
    }

    #[test]
    fn six_and_nine_numbers_and_comments_are_read() {
        let text = "# made by hand\n\ncovariances 2 # two\n1 2 3 4 5 6\n1 2 3  2 4 5  3 5 6 # all nine\n";
        assert_eq!(read(text, 2).unwrap(), [[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]; 2]);
        assert_eq!(read("covariances 0", 0).unwrap(), <[[f64; 6]; 0]>::default());
    }

    #[test]
    fn what_is_written_reads_back_bit_by_bit() {
        let value = |k: u32| (f64::from(k) * 0.37).sin() * 10f64.powi(k as i32 % 25 - 12);
        let all: Vec<[f64; 6]> = (0..40)
            .map(|v| std::array::from_fn(|i| value(6 * v + i as u32)))
            .collect();
        let line = |c: &[f64; 6]| c.map(|v| v.to_string()).join(" ");
        let text = format!(
            "covariances 40\n{}\n",
            all.iter().map(line).collect::<Vec<_>>().join("\n")
        );
        assert_eq!(read(&text, 40).unwrap(), all);
    }

    #[test]
    fn errors_name_the_line() {
        let error = |text: &str| read(text, 2).unwrap_err();
        let one = "1 0 0 1 0 1\n";
        assert!(error("").contains("line 1: expected the header 'covariances'"));
        assert!(error("# c\ncovariance 2").contains("line 2: expected the header"));
        assert!(error("covariances two").contains("expected the header"));
        assert!(error("covariances 3").contains("line 1: the header says 3 vertices, the model has 2"));
        assert!(error(&format!("covariances 2\n{one}")).contains("line 2: the file ends after 1 of 2"));
        assert!(error(&format!("covariances 2\n{one}{one}{one}")).contains("line 4: a covariance more than the 2"));
        assert!(error("covariances 2\n1 0 0 1 0").contains("line 2: a covariance has 6 numbers"));
        assert!(error("covariances 2\n1 0 zero 1 0 1").contains("line 2: 'zero' is no number"));
        assert!(error("covariances 2\n1 0 nan 1 0 1").contains("line 2: covariance is NaN"));
        let turned = error("covariances 2\n1 0 0.5  0 1 0  -0.5 0 1");
        assert!(
            turned.contains("line 2: the matrix is not symmetric: xz is 0.5, zx is -0.5"),
            "{turned}"
        );
    }
}
