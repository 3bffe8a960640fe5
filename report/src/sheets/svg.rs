//! A sheet as SVG, true to scale: a unit of its view is a millimetre.

use std::f64::consts::TAU;
use std::fmt::Write;

use super::drawing::{Page, Shape};

/// The sheet as a file.
pub fn svg(page: &Page) -> String {
    drawn(page, page.shapes.iter())
}

/// The sheet as a small picture: its targets alone.
pub fn sketch(page: &Page) -> String {
    drawn(page, page.shapes.iter().filter(|shape| !matches!(shape, Shape::Line { .. } | Shape::Text { .. })))
}

fn drawn<'a>(page: &Page, shapes: impl Iterator<Item = &'a Shape>) -> String {
    let [width, height] = page.size;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{height}mm\" viewBox=\"0 0 {width} {height}\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n"
    );
    for shape in shapes {
        // Writing into a string does not fail.
        let _ = match shape {
            Shape::Rect { at, size, grey } => writeln!(
                out,
                "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>",
                mm(at[0]),
                mm(at[1]),
                mm(size[0]),
                mm(size[1]),
                colour(*grey)
            ),
            Shape::Disc { at, radius, grey } => {
                let fill = colour(*grey);
                writeln!(
                    out,
                    "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{fill}\"/>",
                    mm(at[0]),
                    mm(at[1]),
                    mm(*radius)
                )
            }
            Shape::Sector { at, radii, turns, grey } => {
                writeln!(out, "<path d=\"{}\" fill=\"{}\"/>", sector(*at, *radii, *turns), colour(*grey))
            }
            Shape::Line { ends: [a, b], width } => writeln!(
                out,
                "<path d=\"M{} {}L{} {}\" stroke=\"#000\" stroke-width=\"{width}\"/>",
                mm(a[0]),
                mm(a[1]),
                mm(b[0]),
                mm(b[1])
            ),
            Shape::Text { at, size, middle, text } => writeln!(
                out,
                "<text x=\"{}\" y=\"{}\" font-size=\"{size}\" font-family=\"Helvetica, Arial, 'Malgun Gothic', 'Apple SD Gothic Neo', 'Noto Sans KR', sans-serif\"{}>{}</text>",
                mm(at[0]),
                mm(at[1]),
                if *middle { " text-anchor=\"middle\"" } else { "" },
                escaped(text)
            ),
        };
    }
    out.push_str("</svg>\n");
    out
}

/// Outline of a ring's sector, whose arcs are split so that none is a half turn or more.
fn sector(at: [f64; 2], radii: [f64; 2], turns: [f64; 2]) -> String {
    let parts = ((turns[1] - turns[0]) * 4.0).ceil().max(1.0) as usize;
    let polar = |radius: f64, part: usize| {
        let turn = TAU * (turns[0] + (turns[1] - turns[0]) * part as f64 / parts as f64);
        format!("{} {}", mm(at[0] + radius * turn.cos()), mm(at[1] + radius * turn.sin()))
    };
    let [inner, outer] = radii;
    let mut d = format!("M{}", polar(outer, 0));
    for part in 1..=parts {
        let _ = write!(d, "A{0} {0} 0 0 1 {1}", mm(outer), polar(outer, part));
    }
    let _ = write!(d, "L{}", polar(inner, parts));
    for part in (0..parts).rev() {
        let _ = write!(d, "A{0} {0} 0 0 0 {1}", mm(inner), polar(inner, part));
    }
    d.push('Z');
    d
}

/// To a tenth of a micrometre.
fn mm(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}

fn colour(grey: f64) -> String {
    let level = (grey * 255.0).round() as u8;
    format!("#{level:02x}{level:02x}{level:02x}")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
