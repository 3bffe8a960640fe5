//! Seeded trials of estimation: clean networks, networks with gross errors, strong distortion. The gate runs a few of each, the
//! bench (`cargo xtask bench estimation`) all of them.

use super::networks::{Uniform, Wanted, brown, exact, noisy};
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Termination};
use sightline::noise::Noise;
use sightline::project::{DatumKind, Parameter, Project};

/// A network of the trials.
pub struct Trial {
    pub name: &'static str,
    pub wanted: Wanted,
    /// Whether every observation is checked well enough for a gross error of ten sigma to be found.
    pub well_controlled: bool,
}

/// Five networks with redundancies of 30 to 2000, noise 0.1 px.
pub fn trials() -> Vec<Trial> {
    let free = vec![brown(&[Parameter::C, Parameter::X0, Parameter::Y0, Parameter::K1])];
    let base = Wanted { sigma_px: 0.1, cameras: free, ..Wanted::default() };
    let held = vec![brown(&[])];
    vec![
        Trial {
            name: "3 photos, 14 points",
            wanted: Wanted { photos: 3, points: 14, cameras: held.clone(), ..base.clone() },
            well_controlled: false,
        },
        Trial {
            name: "2 photos, control",
            wanted: Wanted {
                photos: 2,
                points: 40,
                cameras: held,
                datum: DatumKind::Control,
                control: (20, 0.05),
                ..base.clone()
            },
            well_controlled: false,
        },
        Trial {
            name: "6 photos, 16 points",
            wanted: Wanted { photos: 6, points: 16, ..base.clone() },
            well_controlled: true,
        },
        Trial {
            name: "10 photos, 30 points",
            wanted: Wanted { photos: 10, points: 30, ..base.clone() },
            well_controlled: true,
        },
        Trial {
            name: "16 photos, 80 points",
            wanted: Wanted { photos: 16, points: 80, ..base },
            well_controlled: true,
        },
    ]
}

/// Results of samples of a network without gross errors.
#[derive(Debug, Default)]
pub struct Clean {
    pub redundancy: usize,
    pub sigma0: f64,
    /// Part of the points' coordinates within 1.96 stated standard errors of the truth.
    pub coverage: f64,
    pub thrown: usize,
    pub passed: f64,
}

/// Adjusts noisy copies of the network.
pub fn clean(wanted: &Wanted, options: &AdjustOptions, samples: usize, seed: u64) -> Clean {
    let truth = exact(wanted, seed);
    let mut noise = Noise::new(seed, 1);
    let mut result = Clean::default();
    let (mut inside, mut all, mut solved) = (0.0, 0.0, 0.0);
    for _ in 0..samples {
        let Ok(adjustment) = adjust(&noisy(&truth, &mut noise), options, &mut |_| true) else {
            result.thrown += 1;
            continue;
        };
        solved += 1.0;
        result.redundancy = adjustment.redundancy;
        result.sigma0 += adjustment.sigma0.expect("redundant");
        result.passed += f64::from(u8::from(adjustment.global_test.as_ref().expect("redundant").passed));
        for point in &adjustment.points {
            let known = truth.points.iter().find(|p| p.id == point.id).and_then(|p| p.xyz).expect("known");
            let Some(sigma) = point.sigma else { continue };
            for a in (0..3).filter(|a| sigma[*a] > 1e-12) {
                all += 1.0;
                inside += f64::from(u8::from((point.xyz[a] - known[a]).abs() <= 1.96 * sigma[a]));
            }
        }
    }
    result.sigma0 /= solved;
    result.passed /= solved;
    result.coverage = inside / all;
    result
}

/// Results of samples with gross errors.
#[derive(Debug, Default)]
pub struct Spoiled {
    /// Part of the samples in which every planted error was taken out.
    pub all_found: f64,
    pub thrown: usize,
    pub not_converged: usize,
    /// Observations taken out though nothing was wrong with them, of all.
    pub false_alarms: f64,
    /// sigma0 over that of the same noise without gross errors: median and furthest from 1.
    pub ratio: f64,
    pub furthest: f64,
}

/// Plants errors of 10 to 500 sigma, in any direction of the image, in a share of the rays, and moves all initial values.
pub fn spoil(project: &mut Project, share: f64, largest: f64, random: &mut Uniform) -> Vec<usize> {
    let count = ((project.observations.len() as f64 * share).round() as usize).max(1);
    let mut rows = Vec::new();
    while rows.len() < count {
        let row = (random.between(0.0, 1.0) * project.observations.len() as f64) as usize;
        if rows.contains(&row) {
            continue;
        }
        rows.push(row);
        let o = &mut project.observations[row];
        let size = o.sigma.both()[0] * 10.0 * (random.between(0.0, 1.0) * (largest / 10.0).ln()).exp();
        let (sin, cos) = random.between(0.0, std::f64::consts::TAU).sin_cos();
        o.u += size * cos;
        o.v += size * sin;
    }
    for photo in &mut project.photos {
        photo.position.iter_mut().flatten().for_each(|x| *x += random.between(-20.0, 20.0));
        photo.rotation.iter_mut().flatten().for_each(|x| *x += random.between(-0.01, 0.01));
    }
    for point in project.points.iter_mut().filter(|p| p.sigma.is_none()) {
        point.xyz.iter_mut().flatten().for_each(|x| *x += random.between(-10.0, 10.0));
    }
    rows
}

/// Adjusts noisy copies of the network with planted errors by `options`; found is what has no part or no weight any more.
pub fn spoiled(wanted: &Wanted, options: &AdjustOptions, share: f64, samples: usize, seed: u64) -> Spoiled {
    let truth = exact(wanted, seed);
    let mut noise = Noise::new(seed, 2);
    let mut random = Uniform(seed);
    let mut result = Spoiled::default();
    let mut ratios: Vec<f64> = Vec::new();
    let (mut alarms, mut sound) = (0.0, 0.0);
    for _ in 0..samples {
        let clean = noisy(&truth, &mut noise);
        let mut project = clean.clone();
        let planted = spoil(&mut project, share, 500.0, &mut random);
        let Ok(adjustment) = adjust(&project, options, &mut |_| true) else {
            result.thrown += 1;
            continue;
        };
        result.not_converged += usize::from(adjustment.termination != Termination::Converged);
        let out = |row: &usize| {
            let o = &adjustment.observations[*row];
            !o.enabled || o.weight.is_some_and(|w| w < 0.5)
        };
        result.all_found += f64::from(u8::from(planted.iter().all(out)));
        alarms += (0..project.observations.len()).filter(|row| !planted.contains(row) && out(row)).count() as f64;
        sound += (project.observations.len() - planted.len()) as f64;
        let reference = adjust(&clean, &AdjustOptions::default(), &mut |_| true).expect("solvable");
        ratios.push(adjustment.sigma0.expect("redundant") / reference.sigma0.expect("redundant"));
    }
    result.all_found /= (samples - result.thrown) as f64;
    result.false_alarms = alarms / sound;
    ratios.sort_by(f64::total_cmp);
    result.ratio = ratios[ratios.len() / 2];
    result.furthest = ratios.iter().copied().max_by(|a, b| (a - 1.0).abs().total_cmp(&(b - 1.0).abs())).expect("some");
    result
}

/// The network of the global test with a radial distortion of this K1 and what it amounts to in the corner, pixels.
pub fn distorted(k1: f64) -> (Wanted, f64) {
    let mut camera = brown(&[Parameter::C, Parameter::X0, Parameter::Y0, Parameter::K1, Parameter::K2]);
    for parameter in [Parameter::K2, Parameter::K3] {
        camera.interior.set(parameter, 0.0);
    }
    camera.interior.set(Parameter::K1, k1);
    let radius = 0.005 * 2500.0_f64;
    let wanted = Wanted { photos: 12, points: 60, cameras: vec![camera], sigma_px: 0.1, ..Wanted::default() };
    (wanted, k1 * radius.powi(3) / 0.005)
}
