//! What a RAW was measured on, in a sentence or two.

use sightline::detection::{Colour, Measured, MeasuredOn};

use crate::format;
use crate::i18n::text;

/// Which sites, their noise, and what the file says of its lens.
pub fn sentence(measured: &Measured) -> String {
    let colour = measured.colour.map_or("", colour);
    let pattern = measured.pattern.clone().unwrap_or_default();
    let on = match measured.on {
        MeasuredOn::Sites => text::measured_on_sites(&measured.format, colour, pattern, measured.bits),
        MeasuredOn::InterpolatedSites => text::measured_between_sites(&measured.format, colour, pattern, measured.bits),
    };
    let gain = measured.gain.filter(|gain| *gain > 0.0);
    let noise = match (gain, measured.read_noise) {
        (Some(gain), Some(read)) => Some(text::measured_noise(format::fixed(read, 1), format::fixed(gain, 2))),
        (Some(gain), None) => Some(text::measured_light_noise(format::fixed(gain, 2))),
        (None, Some(read)) => Some(text::measured_read_noise(format::fixed(read, 1))),
        _ => None,
    };
    let hot = measured.hot_sites.filter(|count| *count > 0).map(|count| text::measured_hot(format::count(count)));
    let corrections =
        (!measured.corrections.is_empty()).then(|| text::measured_corrections(measured.corrections.join(", ")));
    [Some(on), noise, hot, corrections].into_iter().flatten().collect::<Vec<_>>().join(" ")
}

fn colour(colour: Colour) -> &'static str {
    match colour {
        Colour::Red => text::site_red(),
        Colour::Green => text::site_green(),
        Colour::Blue => text::site_blue(),
        Colour::Cyan => text::site_cyan(),
        Colour::Magenta => text::site_magenta(),
        Colour::Yellow => text::site_yellow(),
        Colour::White => text::site_white(),
        Colour::Emerald => text::site_emerald(),
    }
}
