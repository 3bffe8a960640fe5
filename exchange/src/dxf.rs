//! Drawings for CAD as ASCII DXF of release 12, which every program reads: points, their names, lines by layer, cameras, fitted forms.
//!
//! That release has layer names of A-Z, 0-9, $, - and _, up to 31 of them, and colours by number: others are transformed to these.
//! Lengths are the project's; a comment names its unit, for which the release has no place.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use super::spatial::{Spatial, colour};
use sightline::adjustment::Adjustment;
use sightline::project::{Project, Role};

/// A point, line or name of a drawing with its layer, as the project names it, and that layer's colour.
pub(super) struct Item {
    pub(super) layer: String,
    pub(super) colour: [u8; 3],
    pub(super) shape: Entity,
}

/// Geometry of a DXF entity.
pub(super) enum Entity {
    Point([f64; 3]),
    Line([f64; 3], [f64; 3]),
    Text([f64; 3], String),
}

/// All that is drawn, in any release.
pub(super) fn items(project: &Project, spatial: &Spatial<'_>, text_height: f64) -> Vec<Item> {
    let mut all = Vec::new();
    let mut draw =
        |layer: &str, colour: [u8; 3], shape: Entity| all.push(Item { layer: layer.to_owned(), colour, shape });
    for spot in &spatial.spots {
        let role = match spot.point.role {
            Role::Tie => "POINTS_TIE",
            Role::Control => "POINTS_CONTROL",
            Role::Check => "POINTS_CHECK",
        };
        draw(role, colour(spot.point.role), Entity::Point(spot.xyz));
        let beside = std::array::from_fn(|k| spot.xyz[k] + if k < 2 { text_height / 2.0 } else { 0.0 });
        draw("NAMES", [128; 3], Entity::Text(beside, spot.point.id.clone()));
    }
    let at: BTreeMap<&str, [f64; 3]> = spatial.spots.iter().map(|s| (s.point.id.as_str(), s.xyz)).collect();
    let colours: BTreeMap<&str, [u8; 3]> = project.layers.iter().map(|l| (l.id.as_str(), l.colour)).collect();
    for line in &project.lines {
        if let (Some(from), Some(to)) = (at.get(line.from.as_str()), at.get(line.to.as_str())) {
            let name = if line.layer.is_empty() { "LINES" } else { &line.layer };
            draw(name, colours.get(line.layer.as_str()).copied().unwrap_or([0; 3]), Entity::Line(*from, *to));
        }
    }
    for view in &spatial.views {
        let [centre, corners @ ..] = view.frustum;
        for k in 0..4 {
            draw("CAMERAS", [110; 3], Entity::Line(centre, corners[k]));
            draw("CAMERAS", [110; 3], Entity::Line(corners[k], corners[(k + 1) % 4]));
        }
        draw("CAMERAS", [110; 3], Entity::Text(centre, view.id.to_owned()));
    }
    // A circle is 72 chords: that of release 12 lies in a system of its own, which readers build differently.
    for (feature, drawn) in &spatial.features {
        drawn.outline.iter().for_each(|[from, to]| draw("FEATURES", [160, 0, 120], Entity::Line(*from, *to)));
        if let Some(at) = drawn.label {
            draw("FEATURES", [160, 0, 120], Entity::Text(at, feature.id.clone()));
        }
    }
    all
}

/// Header of a drawing: its unit, and the user's letters if they differ from those of the drawing.
///
/// A drawing keeps the right-handed system whatever coordinate the user names first: with the northing as X it would be a mirror image.
pub(super) fn title(project: &Project) -> String {
    let axes = project.shown_axes();
    let letters = match project.axes {
        None => String::new(),
        Some(_) => format!(", X = {}, Y = {}, Z = {}", axes.letter(0), axes.letter(1), axes.letter(2)),
    };
    format!("Sightline, unit {}{letters}", project.unit)
}

/// The drawing.
pub fn write(project: &Project, adjustment: Option<&Adjustment>) -> String {
    let spatial = Spatial::of(project, adjustment);
    let mut layers = LayerNames::default();
    let mut body = String::new();
    let text_height = 0.008 * spatial.size;
    for item in items(project, &spatial, text_height) {
        let layer = layers.named(&item.layer, item.colour);
        match item.shape {
            Entity::Point(at) => entity(&mut body, "POINT", &layer, &[(10, at)]),
            Entity::Line(from, to) => entity(&mut body, "LINE", &layer, &[(10, from), (11, to)]),
            Entity::Text(at, words) => label(&mut body, &layer, at, text_height, &words),
        }
    }
    let mut text = String::new();
    pair(&mut text, 999, &ascii(&title(project)));
    header(&mut text, spatial.centre, spatial.size);
    layers.table(&mut text);
    text.push_str("0\nSECTION\n2\nENTITIES\n");
    text.push_str(&body);
    text.push_str("0\nENDSEC\n0\nEOF\n");
    text
}

pub(super) fn pair(text: &mut String, code: u32, value: &str) {
    // Writing into a string does not fail.
    let _ = writeln!(text, "{code}\n{value}");
}

pub(super) fn place(text: &mut String, code: u32, [x, y, z]: [f64; 3]) {
    for (k, value) in [x, y, z].into_iter().enumerate() {
        pair(text, code + 10 * k as u32, &number(value));
    }
}

/// Digits without an exponent, which some readers do not take.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value}");
    if text.contains('.') { text } else { text + ".0" }
}

pub(super) fn entity(text: &mut String, kind: &str, layer: &str, places: &[(u32, [f64; 3])]) {
    pair(text, 0, kind);
    pair(text, 8, layer);
    places.iter().for_each(|(code, xyz)| place(text, *code, *xyz));
}

pub(super) fn label(text: &mut String, layer: &str, at: [f64; 3], height: f64, words: &str) {
    entity(text, "TEXT", layer, &[(10, at)]);
    pair(text, 40, &number(height));
    pair(text, 1, &ascii(words));
}

/// What is not ASCII by its number, as AutoCAD writes it; no line break can end a group.
pub(super) fn ascii(words: &str) -> String {
    let shown = |c: char| match c {
        ' '..='~' => c.to_string(),
        c if c.is_control() => " ".into(),
        c => c.encode_utf16(&mut [0; 2]).iter().map(|unit| format!("\\U+{unit:04X}")).collect(),
    };
    words.chars().map(shown).collect()
}

pub(super) fn header(text: &mut String, centre: [f64; 3], size: f64) {
    text.push_str("0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n");
    let half = size / 2.0;
    for (name, sign) in [("$EXTMIN", -1.0), ("$EXTMAX", 1.0)] {
        pair(text, 9, name);
        place(text, 10, centre.map(|c| c + sign * half));
    }
    // Points as crosses of one in two hundred of the drawing.
    text.push_str("9\n$PDMODE\n70\n2\n9\n$PDSIZE\n40\n");
    let _ = writeln!(text, "{}\n0\nENDSEC", number(0.005 * size));
}

/// Names of layers in the drawing, valid for the release and unique.
#[derive(Default)]
pub(super) struct LayerNames {
    names: BTreeMap<String, (String, u8)>,
    taken: BTreeSet<String>,
}

impl LayerNames {
    pub(super) fn named(&mut self, name: &str, colour: [u8; 3]) -> String {
        if let Some((known, _)) = self.names.get(name) {
            return known.clone();
        }
        let letter =
            |c: char| if c.is_ascii_alphanumeric() || "$-_".contains(c) { c.to_ascii_uppercase() } else { '_' };
        let plain: String = name.chars().map(letter).take(27).collect();
        let mut own = if plain.is_empty() { "_".to_owned() } else { plain.clone() };
        let mut count = 1;
        while !self.taken.insert(own.clone()) {
            count += 1;
            own = format!("{plain}_{count}");
        }
        self.names.insert(name.to_owned(), (own.clone(), index(colour)));
        own
    }

    pub(super) fn table(&self, text: &mut String) {
        let _ = writeln!(text, "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n70\n{}", self.names.len());
        for (name, colour) in self.names.values() {
            let _ = writeln!(text, "0\nLAYER\n2\n{name}\n70\n0\n62\n{colour}\n6\nCONTINUOUS");
        }
        text.push_str("0\nENDTAB\n0\nENDSEC\n");
    }
}

/// Number of the nearest of the release's colours: 24 hues at five brightnesses, full and half as saturated, six greys.
pub(super) fn index(wanted: [u8; 3]) -> u8 {
    const BRIGHT: [f64; 5] = [1.0, 0.65, 0.5, 0.3, 0.15];
    if wanted == [0; 3] {
        // Black on white and white on black.
        return 7;
    }
    let shade = |index: u8| -> [f64; 3] {
        if index >= 250 {
            return [[51.0, 80.0, 105.0, 130.0, 190.0, 255.0][usize::from(index) - 250]; 3];
        }
        let hue = f64::from(index / 10 - 1) * 15.0 / 60.0;
        let value = BRIGHT[usize::from(index % 10 / 2)];
        let pale = if index % 2 == 1 { 0.5 } else { 0.0 };
        let channel = |offset: f64| {
            let k = (offset + hue) % 6.0;
            let full = 1.0 - k.min(4.0 - k).clamp(0.0, 1.0);
            255.0 * value * (pale + (1.0 - pale) * full)
        };
        [channel(5.0), channel(3.0), channel(1.0)]
    };
    let far = |index: u8| shade(index).iter().zip(wanted).map(|(a, b)| (a - f64::from(b)).powi(2)).sum::<f64>();
    (10..=255).min_by(|a, b| far(*a).total_cmp(&far(*b))).unwrap_or(7)
}
