//! Stated against actual errors: many noisy copies of one network.

use crate::support::dense::Dense;
use crate::support::networks::{Wanted, brown, exact, noisy};
use nalgebra::DMatrix;
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Adjustment, Given, ResidualPlace};
use sightline::noise::Noise;
use sightline::project::{DatumKind, Parameter, Project};
use sightline::statistics::distribution::{ALPHA, GLOBAL_ALPHA, critical_w};
use statrs::distribution::{Binomial, DiscreteCDF};

const COPIES: usize = 1000;

/// Test values of observations of every kind, image coordinates first; `None` if nothing checks the observation.
fn test_values(adjustment: &Adjustment) -> Vec<Option<f64>> {
    let given = adjustment.given.iter().map(|g| g.reliability.expect("full").w);
    adjustment.observations.iter().flat_map(|o| [o.wx, o.wy]).chain(given).collect()
}

/// The exact interval that holds a binomial number with a probability of 99 %.
fn band(trials: u64, probability: f64) -> std::ops::RangeInclusive<u64> {
    let binomial = Binomial::new(probability, trials).expect("a probability");
    binomial.inverse_cdf(0.005)..=binomial.inverse_cdf(0.995)
}

/// Tests of one copy over independent tests: by how much their correlation raises the variance of the number of alarms.
///
/// With R = I - A A⁺ the test values have correlations ρ = R_ij/√(R_ii R_jj), and two of them alarm together with the
/// probability α² + Σ_{n even} (ρⁿ/n!)(2 φ(k) He_{n-1}(k))² (Mehler's series of the bivariate normal distribution).
fn design_effect(truth: &Project) -> f64 {
    let options = AdjustOptions { residuals: ResidualPlace::Measured, ..AdjustOptions::default() };
    let adjustment = adjust(truth, &options, &mut |_| true).expect("solvable");
    let (mut a, _) = Dense::new(truth, &adjustment, true).design();
    a.column_iter_mut().for_each(|mut c| c /= c.norm());
    let n = a.nrows();
    let svd = a.svd(true, false);
    let u = svd.u.expect("asked for");
    let kept: Vec<usize> =
        (0..u.ncols()).filter(|k| svd.singular_values[*k] > 1e-7 * svd.singular_values.max()).collect();
    let u = DMatrix::from_fn(n, kept.len(), |i, j| u[(i, kept[j])]);
    let r = DMatrix::identity(n, n) - &u * u.transpose();
    let k = critical_w();
    let density = (-k * k / 2.0).exp() / std::f64::consts::TAU.sqrt();
    let together = |rho: f64| {
        // He_{n+1} = k He_n - n He_{n-1}; (ρⁿ/n!) is carried along.
        let (mut sum, mut before, mut hermite, mut power) = (0.0, 1.0, k, rho);
        for n in 2..100 {
            power *= rho / f64::from(n);
            if n % 2 == 0 {
                sum += power * (2.0 * density * hermite).powi(2);
            }
            (before, hermite) = (hermite, k * hermite - f64::from(n - 1) * before);
        }
        sum
    };
    let tested: Vec<usize> = (0..n).filter(|i| r[(*i, *i)] > 1e-9).collect();
    let pairs = tested.iter().flat_map(|i| tested.iter().map(move |j| (*i, *j))).filter(|(i, j)| i != j);
    let shared: f64 = pairs.map(|(i, j)| together(r[(i, j)] / (r[(i, i)] * r[(j, j)]).sqrt())).sum();
    1.0 + shared / (tested.len() as f64 * ALPHA * (1.0 - ALPHA))
}

fn scatter(wanted: &Wanted, seed: u64) {
    let truth = exact(wanted, seed);
    let options = AdjustOptions { residuals: ResidualPlace::Measured, ..AdjustOptions::default() };
    let mut noise = Noise::new(seed, 1);
    // Per group: sum of squared errors in stated sigmas, and their number.
    let mut groups = [("centres", 0.0, 0.0), ("angles", 0.0, 0.0), ("interior", 0.0, 0.0), ("points", 0.0, 0.0)];
    let (mut squares, mut alarms, mut tests, mut rejected, mut redundancy) = (0.0, 0, 0, 0, 0);
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
        rejected += u64::from(!adjustment.global_test.as_ref().expect("redundant").passed);
        test_values(&adjustment).into_iter().flatten().for_each(|w| {
            tests += 1;
            alarms += u32::from(w.abs() > critical_w());
        });
    }
    for (name, squares, count) in groups {
        let ratio = (squares / count).sqrt();
        assert!((0.97..=1.03).contains(&ratio), "{name}: scatter / sigma {ratio}");
    }
    // The mean of sigma0² has the standard deviation √(2 / (r·copies)).
    let spread = (2.0 / (redundancy * COPIES) as f64).sqrt();
    assert!((squares / COPIES as f64 - 1.0).abs() < 4.0 * spread, "mean sigma0² {}", squares / COPIES as f64);
    // Copies are independent of each other: global tests that fail have a binomial number.
    let expected = band(COPIES as u64, GLOBAL_ALPHA);
    assert!(expected.contains(&rejected), "{rejected} global tests fail, not {expected:?}");
    // Tests of one copy are not: as many alarms vary like those of fewer independent tests.
    let effect = design_effect(&truth);
    let expected = band((f64::from(tests) / effect).round() as u64, ALPHA);
    let counted = (f64::from(alarms) / effect).round() as u64;
    println!("{alarms} false alarms of {tests}; as independent tests {counted}, band {expected:?}, effect {effect:.4}");
    assert!(effect < 1.5 && expected.contains(&counted), "{alarms} alarms of {tests}: {counted}, not {expected:?}");
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

#[test]
fn a_detectable_bias_in_a_given_observation_is_found_with_the_stated_power() {
    let mut camera = small().cameras[0].clone();
    camera.free.retain(|p| *p != Parameter::C);
    camera.sigma = [(Parameter::C, 0.01)].into();
    let wanted = Wanted {
        datum: DatumKind::Control,
        control: (5, 0.05),
        distances: (4, 0.05),
        centre_sigma: 0.5,
        cameras: vec![camera],
        ..small()
    };
    let truth = exact(&wanted, 45);
    let mut noise = Noise::new(45, 1);
    let options = AdjustOptions { residuals: ResidualPlace::Measured, ..AdjustOptions::default() };
    let reference = adjust(&truth, &options, &mut |_| true).expect("solvable");
    let given = reference.given.len();
    assert_eq!(given, 15 + 15 + 4 + 1);
    let (mut found, mut tried) = (0_usize, 0_usize);
    for copy in 0..1505 {
        let at = copy % given;
        let row = &reference.given[at];
        let mdb = row.reliability.expect("full").mdb.expect("checked");
        let mut spoiled = noisy(&truth, &mut noise);
        match &row.what {
            Given::Control { point, axis } => {
                let point = spoiled.points.iter_mut().find(|p| p.id == *point).expect("known");
                point.xyz.as_mut().expect("given")[*axis] += mdb;
            }
            Given::Position { photo, axis } => {
                let photo = spoiled.photos.iter_mut().find(|p| p.id == *photo).expect("known");
                photo.position.as_mut().expect("given")[*axis] += mdb;
            }
            Given::Distance { from, to } => {
                let distance = spoiled.distances.iter_mut().find(|d| d.from == *from && d.to == *to).expect("known");
                distance.length += mdb;
            }
            Given::Parameter { parameter, .. } => {
                let interior = &mut spoiled.cameras[0].interior;
                interior.set(*parameter, interior.get(*parameter).expect("known") + mdb);
            }
        }
        let adjustment = adjust(&spoiled, &options, &mut |_| true).expect("solvable");
        tried += 1;
        let w = adjustment.given[at].reliability.expect("full").w;
        found += usize::from(w.is_some_and(|w| w.abs() > critical_w()));
    }
    let power = found as f64 / tried as f64;
    println!("found {found} of {tried}: {power:.4}");
    assert!((0.77..=0.83).contains(&power), "found {power} of {tried}");
}
