//! Wavefront OBJ.

use std::io::{self, Write};

use super::ExportMesh;

pub(super) fn write(out: &mut impl Write, mesh: &ExportMesh<'_>) -> io::Result<()> {
    writeln!(
        out,
        "# keyleaf: {} vertices, {} triangles",
        mesh.positions.len(),
        mesh.triangles.len()
    )?;
    for [x, y, z] in mesh.positions {
        writeln!(out, "v {x} {y} {z}")?;
    }
    for [x, y, z] in mesh.normals.unwrap_or_default() {
        writeln!(out, "vn {x} {y} {z}")?;
    }
    for triangle in mesh.triangles {
        let [a, b, c] = triangle.map(|v| u64::from(v) + 1);
        match mesh.normals {
            None => writeln!(out, "f {a} {b} {c}")?,
            Some(_) => writeln!(out, "f {a}//{a} {b}//{b} {c}//{c}")?,
        }
    }
    Ok(())
}
