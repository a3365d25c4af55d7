//! All points of a report as rows.

use super::{Point, Quantity, Report, SceneReport};
use crate::error::Measure;

const HEAD: &str = "device,software,backend,driver,commit,profile,scene,camera,width,height,series,setting,ms,ms_low,ms_high,leaves,\
triangles,bytes,threshold_factor,object_max,object_rms,normal_max_degrees,normal_rms_degrees,pixels_max,pixels_rms,silhouette_max,\
silhouette_rms,psnr_db,ssim,in_front,passes_ms";

impl Report {
    /// One row a point, with a header; empty fields were not measured. `in_front` names the errors for which nothing beats the point.
    pub fn csv(&self) -> String {
        let mut lines = vec![HEAD.to_owned()];
        for scene in &self.scenes {
            let fronts = Quantity::ALL.map(|quantity| (quantity, scene.front(quantity)));
            for (i, point) in scene.points.iter().enumerate() {
                let in_front = fronts.iter().filter(|(_, front)| front.contains(&i));
                let names: Vec<String> = in_front
                    .map(|(quantity, _)| format!("{quantity:?}").to_lowercase())
                    .collect();
                lines.push(self.row(scene, point, &names.join(" ")));
            }
        }
        lines.join("\n") + "\n"
    }

    fn row(&self, scene: &SceneReport, point: &Point, in_front: &str) -> String {
        let (device, errors) = (&self.device, &point.errors);
        let maybe = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
        let both = |measure: Option<Measure>| [maybe(measure.map(|m| m.max)), maybe(measure.map(|m| m.rms))];
        let picture = errors.picture;
        let passes: Vec<String> = point
            .passes
            .iter()
            .map(|pass| format!("{}={}", pass.name, pass.ms))
            .collect();
        let cells = [
            vec![
                device.name.clone(),
                device.software.to_string(),
                device.backend.clone(),
                device.driver.clone(),
            ],
            vec![
                self.tool.commit.clone(),
                self.tool.profile.clone(),
                scene.name.clone(),
                scene.camera.clone(),
            ],
            scene.size.map(|side| side.to_string()).into(),
            vec![point.series.clone(), point.label.clone(), point.ms.to_string()],
            vec![maybe(point.spread.map(|s| s.low)), maybe(point.spread.map(|s| s.high))],
            vec![point.leaves.to_string(), point.triangles.to_string()],
            vec![point.bytes.to_string(), point.threshold_factor.to_string()],
            both(errors.object).into(),
            both(errors.normal).into(),
            both(errors.pixels).into(),
            both(errors.silhouette).into(),
            vec![maybe(picture.and_then(|p| p.psnr)), maybe(picture.map(|p| p.ssim))],
            vec![in_front.to_owned(), passes.join(" ")],
        ];
        cells
            .concat()
            .iter()
            .map(|cell| quoted(cell))
            .collect::<Vec<_>>()
            .join(",")
    }
}

/// In double quotes where a comma, a quote or a line break needs them.
fn quoted(cell: &str) -> String {
    if cell.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", cell.replace('"', "\"\""))
    } else {
        cell.to_owned()
    }
}
