//! Exterior orientations with their standard errors.

use crate::context::{Context, smallest};
use crate::html::{Html, Table};
use crate::number::{decimals_for, fixed, maybe};

pub fn write(context: &Context, html: &mut Html) {
    let (words, unit) = (context.words, context.unit);
    let mut positions = Table::new().words(words.photo()).words(words.file());
    let mut angles = Table::new().words(words.photo());
    for axis in context.axes.names() {
        positions = positions.low(axis, "", unit);
    }
    for axis in context.axes.names() {
        positions = positions.low("σ", axis, unit);
    }
    for angle in ["ω", "φ", "κ"] {
        angles = angles.low(angle, "", "°");
    }
    for angle in ["ω", "φ", "κ"] {
        angles = angles.low("σ", angle, "°");
    }
    for photo in &context.adjustment.photos {
        let decimals = photo.sigma_position.map_or(3, |s| decimals_for(smallest(&s)));
        let mut row = vec![photo.id.clone(), context.file_of(&photo.id).to_owned()];
        row.extend(context.axes.shown(photo.position).map(|x| fixed(x, decimals)));
        row.extend((0..3).map(|k| maybe(photo.sigma_position.map(|s| context.axes.shown(s)[k]), decimals)));
        positions.row(row);
        let sigma = photo.sigma_rotation.map(|s| s.map(f64::to_degrees));
        let decimals = sigma.map_or(4, |s| decimals_for(smallest(&s)).min(6));
        let mut row = vec![photo.id.clone()];
        row.extend(photo.rotation.map(|angle| fixed(angle.to_degrees(), decimals)));
        row.extend((0..3).map(|k| maybe(sigma.map(|s| s[k]), decimals)));
        angles.row(row);
    }
    html.note(words.orientation_convention());
    html.h3(words.projection_centres()).table(positions.dense());
    html.h3(words.angles()).table(angles.dense());
}
