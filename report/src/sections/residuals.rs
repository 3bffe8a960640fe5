//! Residuals photo by photo.

use std::collections::HashMap;

use crate::context::{Context, largest_w};
use crate::html::{Html, Table};
use crate::number::{count, fixed, maybe};
use sightline::adjustment::AdjustedObservation;

pub fn write(context: &Context, html: &mut Html) {
    let (words, a, unit) = (context.words, context.adjustment, context.residual_unit);
    let mut by_photo: HashMap<&str, Vec<&AdjustedObservation>> = HashMap::new();
    for o in a.observations.iter().filter(|o| o.enabled) {
        by_photo.entry(&o.photo).or_default().push(o);
    }
    let mut table = Table::new().words(words.photo()).words(words.camera()).number(words.points());
    table = table.low(words.rms(), "x", unit).low(words.rms(), "y", unit).low(words.largest(), "", unit);
    table = table.number(words.mean_r()).number(&format!("|w| > {}", fixed(a.criteria.w, 2)));
    for photo in &a.photos {
        let [fx, fy] = context.residual_factors(&photo.id);
        let decimals = context.residual_decimals(&photo.id);
        let own = by_photo.get(photo.id.as_str()).map(Vec::as_slice).unwrap_or_default();
        let largest = own.iter().filter_map(|o| Some((o.vx? * fx).hypot(o.vy? * fy))).reduce(f64::max);
        let redundancy: Vec<f64> = own.iter().flat_map(|o| [o.rx, o.ry]).flatten().collect();
        let mean = (!redundancy.is_empty()).then(|| redundancy.iter().sum::<f64>() / redundancy.len() as f64);
        let over = own.iter().filter(|o| largest_w(o).is_some_and(|w| w.abs() > a.criteria.w)).count();
        table.row(vec![
            photo.id.clone(),
            context.camera_of(&photo.id).map(|camera| camera.id.clone()).unwrap_or_default(),
            count(photo.points),
            fixed(photo.rms_x * fx, decimals),
            fixed(photo.rms_y * fy, decimals),
            maybe(largest, decimals),
            maybe(mean, 2),
            count(over),
        ]);
    }
    html.table(table);
}
