//! Style of the report: black on white with one blue and one orange, independent of the desk's theme.

use super::context::Context;
use sightline::project::{Paper, ReportSettings};

/// CSS for the page size, margins, running header and footer and page numbers of an adjustment report.
pub fn page(context: &Context) -> String {
    let words = context.words;
    pages(context.settings(), context.title(), words.report_title(), &words.all_sigmas(&context.unit))
}

/// The same CSS for any report: its title, the kind of report, and a note that applies to all its numbers.
pub fn pages(settings: &ReportSettings, title: &str, kind: &str, note: &str) -> String {
    let size = match settings.paper {
        Paper::A4 => "A4",
        Paper::Letter => "letter",
    };
    let version = format!("Sightline {}", env!("CARGO_PKG_VERSION"));
    // Symmetric widths, so that the border lines of the three boxes join.
    let boxes = [
        ("top-left", "left", 35, quoted(title)),
        ("top-center", "center", 30, quoted(kind)),
        ("top-right", "right", 35, "counter(page) \" / \" counter(pages)".to_owned()),
        ("bottom-left", "left", 35, quoted(note)),
        ("bottom-center", "center", 30, quoted(&version)),
        ("bottom-right", "right", 35, quoted(&settings.date)),
    ];
    // A report without its own title has its kind as title: do not print it twice, but keep the box for its line.
    let boxes = boxes.map(|(place, align, width, content)| {
        let again = place == "top-center" && title == kind;
        (place, align, width, if again { quoted("") } else { content })
    });
    let mut text = format!("@page {{\n  size: {size};\n  margin: 24mm 18mm 22mm;\n");
    for (place, align, width, content) in boxes {
        let (edge, baseline) = if place.starts_with("top") { ("bottom", "bottom") } else { ("top", "top") };
        let space = if edge == "bottom" {
            "padding-bottom: 2mm; margin-bottom: 4mm"
        } else {
            "padding-top: 2mm; margin-top: 4mm"
        };
        text.push_str(&format!(
            "  @{place} {{ content: {content}; width: {width}%; text-align: {align}; vertical-align: {baseline}; \
             border-{edge}: 0.5pt solid #50585e; {space}; color: #50585e; font: 7.5pt {FONT}; }}\n"
        ));
    }
    text.push_str("}\n");
    // The first page has the title as a heading, so the header leaves it out.
    text.push_str("@page :first { @top-left { content: \"\"; } }\n");
    text
}

/// A quoted CSS string of at most 80 characters, escaped so that the text cannot end the string, the rule or the element.
fn quoted(text: &str) -> String {
    let mut safe = String::from("\"");
    for c in text.chars().take(80) {
        match c {
            '"' | '\\' | '<' | '>' => safe.push_str(&format!("\\{:x} ", c as u32)),
            c if c.is_control() => safe.push(' '),
            c => safe.push(c),
        }
    }
    safe.push('"');
    safe
}

const FONT: &str = "-apple-system, \"Segoe UI\", Roboto, \"Noto Sans\", \"Apple SD Gothic Neo\", \"Malgun Gothic\", \"Noto Sans KR\", \"Noto Sans CJK KR\", \"Liberation Sans\", \"DejaVu Sans\", sans-serif";

/// Style of the contents. Every selector is below `.report` or `.plot`, so that it does not affect the desk.
pub const STYLE: &str = concat!(include_str!("style.css"), include_str!("plots.css"));

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn a_title_stays_in_its_quotes() {
        assert_eq!(quoted("a\"b\\c</style>\n"), "\"a\\22 b\\5c c\\3c /style\\3e  \"");
        let rules = STYLE.lines().filter(|line| line.ends_with('{') && !line.starts_with([' ', '@']));
        assert!(
            rules.clone().count() > 30 && rules.clone().all(|line| line.contains(".report") || line.contains(".plot"))
        );
    }
}
