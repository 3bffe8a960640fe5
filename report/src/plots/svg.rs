//! Writes SVG: coordinates with one decimal, escaped text, title and description for accessibility.

use std::fmt::Write;

use crate::html::escaped;

/// A drawing in the making.
pub struct Svg {
    text: String,
}

/// Alignment of a text.
#[derive(Clone, Copy)]
pub enum Anchor {
    Start,
    Middle,
    End,
}

/// A coordinate as it is written; a place that does not exist is none.
fn at(value: f64) -> f64 {
    if value.is_finite() { (value.clamp(-1e5, 1e5) * 10.0).round() / 10.0 } else { 0.0 }
}

impl Svg {
    /// An empty drawing.
    pub fn new(width: f64, height: f64, title: &str, description: &str) -> Self {
        let (title, description) = (escaped(title), escaped(description));
        Self {
            text: format!(
                "<svg class=\"plot\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{title}\"><title>{title}</title><desc>{description}</desc>\n",
                at(width),
                at(height)
            ),
        }
    }

    /// The drawing.
    pub fn finish(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }

    // Writing to a String does not fail.
    pub fn line(&mut self, class: &str, from: [f64; 2], to: [f64; 2]) {
        let [[x1, y1], [x2, y2]] = [from, to].map(|p| p.map(at));
        let _ = writeln!(self.text, "<line class=\"{class}\" x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\"/>");
    }

    /// A line through places.
    pub fn path(&mut self, class: &str, places: &[[f64; 2]]) {
        if places.is_empty() {
            return;
        }
        let _ = write!(self.text, "<path class=\"{class}\" d=\"");
        for (k, [x, y]) in places.iter().enumerate() {
            let _ = write!(self.text, "{}{} {}", if k == 0 { 'M' } else { 'L' }, at(*x), at(*y));
        }
        self.text.push_str("\"/>\n");
    }

    /// Many short lines of one class as one element.
    pub fn strokes(&mut self, class: &str, lines: &[([f64; 2], [f64; 2])]) {
        if lines.is_empty() {
            return;
        }
        let _ = write!(self.text, "<path class=\"{class}\" d=\"");
        for (from, to) in lines {
            let [[x1, y1], [x2, y2]] = [*from, *to].map(|p| p.map(at));
            let _ = write!(self.text, "M{x1} {y1}L{x2} {y2}");
        }
        self.text.push_str("\"/>\n");
    }

    /// Dots of one class as one element: round caps of a line that has some length, since not every printer draws those of none.
    pub fn dots(&mut self, class: &str, places: &[[f64; 2]], size: f64) {
        if places.is_empty() {
            return;
        }
        let _ = write!(self.text, "<path class=\"{class}\" stroke-width=\"{}\" d=\"", at(size));
        for place in places {
            let [x, y] = place.map(at);
            let _ = write!(self.text, "M{x} {y}h.01");
        }
        self.text.push_str("\"/>\n");
    }

    pub fn rect(&mut self, class: &str, [x, y]: [f64; 2], [width, height]: [f64; 2]) {
        let [x, y, width, height] = [x, y, width.max(0.0), height.max(0.0)].map(at);
        let _ =
            writeln!(self.text, "<rect class=\"{class}\" x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"/>");
    }

    /// An ellipse by its half axes and the angle of the first to x, downwards positive, degrees.
    pub fn ellipse(&mut self, class: &str, [x, y]: [f64; 2], [a, b]: [f64; 2], angle: f64) {
        let [x, y, a, b, angle] = [x, y, a, b, angle].map(at);
        let _ = writeln!(
            self.text,
            "<ellipse class=\"{class}\" rx=\"{a}\" ry=\"{b}\" transform=\"translate({x} {y}) rotate({angle})\"/>"
        );
    }

    pub fn label(&mut self, class: &str, [x, y]: [f64; 2], anchor: Anchor, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let [x, y] = [x, y].map(at);
        let text = escaped(text);
        let _ =
            writeln!(self.text, "<text class=\"{class}\" x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\">{text}</text>");
    }
}
