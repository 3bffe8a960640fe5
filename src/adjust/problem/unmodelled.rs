//! Extra image error that the standard error of a measurement does not include: lens, flatness of targets, light, compression.
//!
//! A target's centre is measured to a hundredth of a pixel while the model of the photo is often good to a tenth. With one
//! standard deviation u for what is not modelled, σ² = s² + u² for every image coordinate of own standard error s.

use std::borrow::Cow;

use crate::adjustment::Adjustment;
use crate::error::{Error, Place, Reason, Result};
use crate::project::{Project, Sigma};

/// The project with `px` added in quadrature to the standard errors of all image coordinates.
///
/// # Errors
/// [`Error::Invalid`] unless `px` is a finite number from 0.
pub fn weighted(project: &Project, px: f64) -> Result<Cow<'_, Project>> {
    if !(0.0..1e6).contains(&px) {
        return Err(Error::Invalid { reason: Reason::Unmodelled { value: px.into() }, at: Place::field("unmodelled") });
    }
    if px == 0.0 {
        return Ok(Cow::Borrowed(project));
    }
    let mut project = project.clone();
    for observation in &mut project.observations {
        observation.sigma = match observation.sigma {
            Sigma::One(s) => Sigma::One(s.hypot(px)),
            Sigma::Two([su, sv]) => Sigma::Two([su.hypot(px), sv.hypot(px)]),
        };
    }
    Ok(Cow::Owned(project))
}

/// The u in pixels with which the image residuals v of an adjustment would agree with their standard errors:
/// u² = Σv² / Σr - mean s², over all image coordinates that took part, r their redundancy numbers.
///
/// None without redundancy numbers, or where the residuals are no larger than the standard errors say.
pub fn estimate(project: &Project, adjustment: &Adjustment) -> Option<f64> {
    let pitches: std::collections::HashMap<&str, [f64; 2]> = project
        .photos
        .iter()
        .filter_map(|photo| {
            let camera = project.cameras.iter().find(|camera| camera.id == photo.camera)?;
            Some((photo.id.as_str(), camera.residual_pitch()))
        })
        .collect();
    let (mut squares, mut redundancy, mut own, mut count) = (0.0, 0.0, 0.0, 0.0);
    for (row, observation) in adjustment.observations.iter().zip(&project.observations).filter(|(row, _)| row.enabled) {
        let [px, py] = *pitches.get(row.photo.as_str())?;
        let [su, sv] = observation.sigma.both();
        squares += (row.vx? / px).powi(2) + (row.vy? / py).powi(2);
        redundancy += row.rx? + row.ry?;
        own += su * su + sv * sv;
        count += 2.0;
    }
    let square = squares / redundancy - own / count;
    (square > 0.0 && square.is_finite()).then(|| square.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::adjust::adjust;
    use crate::adjustment::AdjustOptions;
    use crate::network::{Network, NetworkPoint, Station, simulate};
    use crate::project::Interior;
    use crate::project::{Camera, DatumKind};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    /// Six photos around a block of points; every image coordinate is off by 0.12 px and says 0.02.
    fn project() -> Project {
        let camera = Camera { pixel_pitch: Some([0.005; 2]), ..Camera::new("c", 2000, 1600, Interior::brown(12.0)) };
        let point = |k: u32| NetworkPoint {
            id: k.to_string(),
            xyz: [f64::from(k % 6) * 100.0, f64::from(k / 6 % 6) * 100.0, f64::from(k * 7 % 5) * 40.0],
            ..NetworkPoint::default()
        };
        let station = |k: u32| {
            let turn = f64::from(k);
            let position = [250.0 + 900.0 * turn.cos(), 250.0 + 900.0 * turn.sin(), 900.0];
            Station::aimed(format!("s{k}"), "c", position, [250.0, 250.0, 80.0], turn)
        };
        let mut project = simulate(&Network {
            cameras: vec![camera],
            stations: (0..6).map(station).collect(),
            points: (0..36).map(point).collect(),
            sigma: Sigma::One(0.02),
            noise: Some(Sigma::One(0.12)),
            ..Network::default()
        })
        .unwrap();
        project.datum.kind = DatumKind::Free;
        project
    }

    #[test]
    fn what_is_estimated_makes_the_residuals_agree() {
        let project = project();
        let with = |unmodelled| {
            let options = AdjustOptions { unmodelled, ..AdjustOptions::default() };
            adjust(&project, &options, &mut |_| true).unwrap()
        };
        let plain = with(0.0);
        assert!(plain.sigma0.unwrap() > 5.0);
        let found = estimate(&project, &plain).unwrap();
        // 432 coordinates: 0.118 within four of its standard errors.
        assert!((found - (0.12f64.powi(2) - 0.02f64.powi(2)).sqrt()).abs() < 0.02, "{found}");
        let weighted = with(found);
        assert!((weighted.sigma0.unwrap() - 1.0).abs() < 0.01, "{:?}", weighted.sigma0);
        assert!(weighted.global_test.unwrap().passed);
        // One sigma for all coordinates moves no value.
        for (a, b) in plain.points.iter().zip(&weighted.points) {
            assert!(a.xyz.iter().zip(b.xyz).all(|(a, b)| (a - b).abs() < 1e-6), "{a:?} {b:?}");
        }
    }

    #[test]
    fn impossible_numbers_are_refused() {
        let project = project();
        for unmodelled in [-0.1, f64::NAN, f64::INFINITY] {
            let options = AdjustOptions { unmodelled, ..AdjustOptions::default() };
            let error = adjust(&project, &options, &mut |_| true).unwrap_err();
            assert_eq!(error.place(), Place::field("unmodelled"));
        }
    }
}
