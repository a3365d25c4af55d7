//! STL, binary. Vertices are not shared: equal positions have equal bits.

use std::io::{self, Write};

use glam::Vec3;

use super::ExportMesh;

pub(super) fn write(out: &mut impl Write, mesh: &ExportMesh<'_>) -> io::Result<()> {
    let mut header = [b' '; 80];
    // Not "solid", which would make some readers take it for text.
    header[..7].copy_from_slice(b"keyleaf");
    out.write_all(&header)?;
    let count = u32::try_from(mesh.triangles.len())
        .map_err(|_| io::Error::new(io::ErrorKind::InvalidInput, "STL holds at most 2^32 - 1 triangles"))?;
    out.write_all(&count.to_le_bytes())?;
    for triangle in mesh.triangles {
        let corners = triangle.map(|v| mesh.positions[v as usize]);
        let [a, b, c] = corners.map(Vec3::from);
        let normal = (b - a).cross(c - a).normalize_or_zero().to_array();
        for number in [normal, corners[0], corners[1], corners[2]].as_flattened() {
            out.write_all(&number.to_le_bytes())?;
        }
        out.write_all(&[0, 0])?;
    }
    Ok(())
}
