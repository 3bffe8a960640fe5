//! Standard errors estimated from the residuals, shown in place of a verdict.

use sightline::adjustment::{Adjustment, ObservationGroup, VarianceComponent};

use crate::format;
use crate::i18n::text;

/// A group's name.
pub fn group_name(group: &ObservationGroup) -> String {
    match group {
        ObservationGroup::Image { camera: Some(camera) } => format!("{} {camera}", text::image_coordinates()),
        ObservationGroup::Image { camera: None } => text::image_coordinates().to_owned(),
        ObservationGroup::Control => text::control_coordinates().to_owned(),
        ObservationGroup::Position => text::projection_centre().to_owned(),
        ObservationGroup::Distance => text::distances().to_owned(),
        ObservationGroup::Parameter => text::camera_parameter().to_owned(),
    }
}

/// "1.88 times the a priori 0.0082 px".
pub fn times(factor: f64, sigma: Option<f64>, a_priori_px: Option<f64>) -> String {
    let factor = format::fixed(factor, sigma.map_or(2, format::decimals_for).max(2));
    match a_priori_px {
        Some(px) => text::times_a_priori_px(factor, format::fixed(px, format::decimals_for(px))),
        None => text::times_a_priori(factor),
    }
}

/// Of every group that was estimated; `None` if none was.
pub fn estimated(adjustment: &Adjustment) -> Option<String> {
    let all = &adjustment.variance_components;
    let one = |component: &VarianceComponent| {
        let mut said = times(component.factor, component.factor_sigma, component.a_priori_px);
        if let Some(px) = component.unmodelled.filter(|px| *px > 0.0) {
            said = text::and_unmodelled(said, format::fixed(px, format::decimals_for(px)));
        }
        if all.len() > 1 { format!("{}: {said}", group_name(&component.group)) } else { said }
    };
    let said: Vec<String> = all.iter().filter(|c| c.not_estimated.is_none()).map(one).collect();
    (!said.is_empty()).then(|| text::standard_errors_estimated(said.join("; ")))
}
