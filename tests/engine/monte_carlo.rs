//! Stated against actual errors: many noisy copies of one network.

use crate::networks::{Wanted, brown, exact, noisy};
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, ResidualPlace};
use sightline::noise::Noise;
use sightline::project::{DatumKind, Parameter};
use sightline::statistics::distribution::critical_w;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

const COPIES: usize = 1000;

fn scatter(wanted: &Wanted, seed: u64) {
    let truth = exact(wanted, seed);
    let options = AdjustOptions { residuals: ResidualPlace::Measured, ..AdjustOptions::default() };
    let mut noise = Noise::new(seed, 1);
    // Per group: sum of squared errors in stated sigmas, and their number.
    let mut groups = [("centres", 0.0, 0.0), ("angles", 0.0, 0.0), ("interior", 0.0, 0.0), ("points", 0.0, 0.0)];
    let (mut squares, mut alarms, mut tests, mut redundancy) = (0.0, 0, 0, 0);
    for _ in 0..COPIES {
        let adjustment = adjust(&noisy(&truth, &mut noise), &options, &mut |_| true).expect("solvable");
        let s0 = adjustment.sigma0.expect("redundant");
        squares += s0 * s0;
        redundancy = adjustment.redundancy;
        let mut add = |group: usize, error: f64, sigma: f64| {
            if sigma > 1e-12 {
                // The stated sigma with the a priori variance factor, which is the true one here.
                groups[group].1 += (error / (sigma / s0)).powi(2);
                groups[group].2 += 1.0;
            }
        };
        for (photo, known) in adjustment.photos.iter().zip(&truth.photos) {
            for a in 0..3 {
                let sigma = photo.sigma_position.expect("full")[a];
                add(0, photo.position[a] - known.position.expect("known")[a], sigma);
                let turn = photo.rotation[a] - known.rotation.expect("known")[a];
                let turn = turn - (turn / std::f64::consts::TAU).round() * std::f64::consts::TAU;
                add(1, turn, photo.sigma_rotation.expect("full")[a]);
            }
        }
        for (parameter, sigma) in &adjustment.cameras[0].sigma {
            let value = |c: &sightline::project::Camera| c.interior.get(*parameter).expect("known");
            add(2, value(&adjustment.cameras[0].camera) - value(&truth.cameras[0]), *sigma);
        }
        for (point, known) in adjustment.points.iter().zip(&truth.points) {
            let sigma = point.sigma.expect("full");
            (0..3).for_each(|a| add(3, point.xyz[a] - known.xyz.expect("known")[a], sigma[a]));
        }
        let w = adjustment.observations.iter().flat_map(|o| [o.wx, o.wy]).flatten();
        w.for_each(|w| {
            tests += 1;
            alarms += usize::from(w.abs() > critical_w());
        });
    }
    for (name, squares, count) in groups {
        let ratio = (squares / count).sqrt();
        assert!((0.97..=1.03).contains(&ratio), "{name}: scatter / sigma {ratio}");
    }
    // The mean of sigma0² has the standard deviation √(2 / (r·copies)).
    let spread = (2.0 / (redundancy * COPIES) as f64).sqrt();
    assert!((squares / COPIES as f64 - 1.0).abs() < 4.0 * spread, "mean sigma0² {}", squares / COPIES as f64);
    let expected = 0.001 * tests as f64;
    assert!((alarms as f64 - expected).abs() < 5.0 * expected.sqrt(), "{alarms} false alarms of {tests}");
}

fn small() -> Wanted {
    let free = [Parameter::C, Parameter::X0, Parameter::Y0, Parameter::K1, Parameter::K2];
    let mut camera = brown(&free);
    // Distortion of more than a hundred pixels in the corners.
    camera.interior.set(Parameter::K1, 4e-4);
    Wanted { photos: 5, points: 12, cameras: vec![camera], sigma_px: 0.1, ..Wanted::default() }
}

#[test]
fn a_free_network_scatters_as_stated() {
    scatter(&small(), 41);
}

#[test]
fn a_minimal_datum_scatters_as_stated() {
    scatter(&Wanted { datum: DatumKind::Minimal, ..small() }, 42);
}

#[test]
fn a_controlled_network_scatters_as_stated() {
    scatter(&Wanted { datum: DatumKind::Control, control: (4, 0.05), distances: (2, 0.05), ..small() }, 43);
}

#[test]
fn a_bias_of_the_detectable_size_is_found_with_the_stated_power() {
    let truth = exact(&small(), 44);
    let mut noise = Noise::new(44, 1);
    let options = AdjustOptions { residuals: ResidualPlace::Measured, ..AdjustOptions::default() };
    let reference = adjust(&noisy(&truth, &mut noise), &options, &mut |_| true).expect("solvable");
    let (mut found, mut tried) = (0_usize, 0_usize);
    for copy in 0..1500 {
        let row = copy * 7 % truth.observations.len();
        let Some(mdb) = reference.observations[row].mdb_x else { continue };
        let mut spoiled = noisy(&truth, &mut noise);
        spoiled.observations[row].u += mdb / spoiled.cameras[0].pitch()[0];
        let adjustment = adjust(&spoiled, &options, &mut |_| true).expect("solvable");
        tried += 1;
        found += usize::from(adjustment.observations[row].wx.is_some_and(|w| w.abs() > critical_w()));
    }
    let power = found as f64 / tried as f64;
    assert!((0.77..=0.83).contains(&power), "found {power} of {tried}");
}
