//! Shapes on a sheet, in millimetres from its top left corner, x right, y down.

/// A shape. Greys are shares of white: 0 is ink, 1 is paper. Later shapes cover earlier ones.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A filled rectangle.
    Rect {
        /// Left and top edge.
        at: [f64; 2],
        /// Width and height.
        size: [f64; 2],
        /// Grey.
        grey: f64,
    },
    /// A filled circle.
    Disc {
        /// Centre.
        at: [f64; 2],
        /// Radius.
        radius: f64,
        /// Grey.
        grey: f64,
    },
    /// A sector of a ring.
    Sector {
        /// Centre.
        at: [f64; 2],
        /// Inner and outer radius.
        radii: [f64; 2],
        /// Start and end in turns, clockwise from three o'clock; the end is larger.
        turns: [f64; 2],
        /// Grey.
        grey: f64,
    },
    /// A thin line of ink.
    Line {
        /// Its ends.
        ends: [[f64; 2]; 2],
        /// Its width.
        width: f64,
    },
    /// Text without serifs, of ink.
    Text {
        /// Left (or middle) end of the base line.
        at: [f64; 2],
        /// Size of the font.
        size: f64,
        /// Whether `at` is the middle of the text, which has digits only.
        middle: bool,
        /// Printable characters.
        text: String,
    },
}

/// A sheet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Page {
    /// Width and height, mm.
    pub size: [f64; 2],
    /// Short description of its purpose.
    pub title: String,
    /// Printed shapes.
    pub shapes: Vec<Shape>,
}

/// Width of a digit of Helvetica over the size of the font.
pub const DIGIT: f64 = 0.556;

impl Page {
    /// Adds ink along a line.
    pub fn line(&mut self, from: [f64; 2], to: [f64; 2], width: f64) {
        self.shapes.push(Shape::Line { ends: [from, to], width });
    }

    /// Adds text that begins at a place.
    pub fn text(&mut self, at: [f64; 2], size: f64, text: impl Into<String>) {
        self.shapes.push(Shape::Text { at, size, middle: false, text: printable(&text.into()) });
    }

    /// Adds digits around a place.
    pub fn digits(&mut self, at: [f64; 2], size: f64, number: u32) {
        self.shapes.push(Shape::Text { at, size, middle: true, text: number.to_string() });
    }
}

/// Without line breaks and other controls.
fn printable(text: &str) -> String {
    text.chars().filter(|c| !c.is_control()).map(|c| if c == '\u{a0}' { ' ' } else { c }).collect()
}
