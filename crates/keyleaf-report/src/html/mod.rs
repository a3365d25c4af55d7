//! The report as one HTML file: style and figures inside, no scripts, nothing to fetch.
//!
//! | file | makes |
//! |---|---|
//! | `figures` | the figures of a scene |
//! | `tables` | its tables, and the one of scaling |
//! | `page.css` | the look: one column on a phone, two on a wide screen, light, dark, and on paper |

mod figures;
mod tables;
#[cfg(test)]
mod tests;

pub use figures::{Figure, figures};

use crate::report::{Report, SceneReport};
use crate::svg::{self, escape};

const STYLE: &str = include_str!("page.css");

/// The whole page.
pub fn page(report: &Report) -> String {
    let title = escape(&report.title);
    let scenes: Vec<String> = report
        .scenes
        .iter()
        .enumerate()
        .map(|(i, scene)| section(report, scene, i))
        .collect();
    let scaling = report
        .scaling
        .as_ref()
        .map_or(String::new(), |table| tables::scaling(table, &report.device));
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n\
         <title>{title}</title>\n<style>\n{STYLE}{}</style>\n</head>\n<body>\n<main>\n<h1>{title}</h1>\n{}{}{}{}{scaling}\
         </main>\n</body>\n</html>\n",
        svg::STYLE,
        tables::device(report),
        paragraphs(&report.notes),
        contents(report),
        scenes.concat(),
    )
}

fn paragraphs(texts: &[String]) -> String {
    texts.iter().map(|text| format!("<p>{}</p>\n", escape(text))).collect()
}

/// Links to the sections.
fn contents(report: &Report) -> String {
    let link = |target: &str, name: &str| format!("<a href=\"#{target}\">{}</a>\n", escape(name));
    let scenes = report.scenes.iter().enumerate();
    let mut links: String = scenes
        .map(|(i, scene)| link(&format!("scene-{i}"), &scene.name))
        .collect();
    if report.scaling.is_some() {
        links += &link("scaling", "scaling");
    }
    format!("<nav>\n{links}</nav>\n")
}

fn section(report: &Report, scene: &SceneReport, index: usize) -> String {
    let caption = caption(report, scene);
    let figures: String = figures(scene)
        .into_iter()
        .map(|figure| {
            format!(
                "<figure>\n<h3>{}</h3>\n{}<figcaption>{}{}</figcaption>\n</figure>\n",
                escape(&figure.title),
                figure.svg,
                sentence(&figure.remark),
                escape(&caption)
            )
        })
        .collect();
    format!(
        "<section id=\"scene-{index}\">\n<h2>{}</h2>\n{}<div class=\"figures\">\n{figures}</div>\n{}{}</section>\n",
        escape(&scene.name),
        paragraphs(&scene.notes),
        tables::slopes(scene),
        tables::points(scene, &caption),
    )
}

fn sentence(text: &str) -> String {
    if text.is_empty() {
        String::new()
    } else {
        format!("{} ", escape(text))
    }
}

/// What every figure says of where its numbers come from.
fn caption(report: &Report, scene: &SceneReport) -> String {
    let (device, tool) = (&report.device, &report.tool);
    let commit = if tool.commit.is_empty() {
        "unknown commit"
    } else {
        &tool.commit
    };
    let mut parts = vec![device.name.clone(), device.backend.clone()];
    parts.extend(device.software.then(|| "not a GPU time".to_owned()));
    parts.push(format!("{} × {} pixels", scene.size[0], scene.size[1]));
    parts.push(format!("scene {}, camera {}", scene.name, scene.camera));
    parts.push(format!("commit {commit}, {} build", tool.profile));
    parts.join("; ") + "."
}
