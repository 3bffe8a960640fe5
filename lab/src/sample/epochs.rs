//! Three epochs of a dam face, simulated: targets that move by known multiples of their standard errors, and a reference point that is
//! not stable.
//!
//! 24 targets on the downstream face of an arch dam, eight reference points on the abutments and the rock before it, two scale bars,
//! twelve photos of 24 megapixels, adjusted as a free network in each epoch with the same cameras and other noise. Movements are
//! multiples of √2 σ, the standard error of a displacement between two epochs of the first one's precision.

use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Adjustment};
use sightline::error::Result;
use sightline::monitoring::Epoch;
use sightline::project::{Camera, Datum, DatumKind, Interior, Parameter, Project, Sigma};
use sightline_plan::network::{Bar, Network, NetworkPoint, Station, simulate};

/// Dates of the epochs.
const DATES: [&str; 3] = ["2026-03-14", "2026-06-13", "2026-09-12"];
/// Targets that move downstream, and by how many standard errors from the first epoch to the last; at a constant velocity.
pub const MOVED: [(&str, f64); 4] = [("D23", 10.0), ("D24", 10.0), ("D33", 3.0), ("D34", 3.0)];
/// The reference point that moved before the second epoch, and by how many standard errors.
pub const UNSTABLE: (&str, f64) = ("R5", 10.0);

/// Half the length of the crest, its height, and the radius of the face, mm.
const HALF: f64 = 20_000.0;
const HEIGHT: f64 = 16_000.0;
const RADIUS: f64 = 45_000.0;
/// Standard error of the image coordinates, pixels, and of the scale bars, mm.
const IMAGE_PX: f64 = 0.06;
const BAR_MM: f64 = 0.1;

/// A place of the face: along the crest and upwards.
fn face(x: f64, z: f64) -> [f64; 3] {
    [x, RADIUS - (RADIUS * RADIUS - x * x).sqrt(), z]
}

fn points() -> Vec<NetworkPoint> {
    let point = |id: String, xyz: [f64; 3]| NetworkPoint { id, xyz, ..NetworkPoint::default() };
    let row = |i: usize| {
        (1..=6).map(move |j| {
            let (x, z) = ((j as f64 - 3.5) * HALF / 3.3, (0.2 + 0.2 * i as f64) * HEIGHT);
            point(format!("D{i}{j}"), face(x, z))
        })
    };
    let reference = [
        [-26_000.0, 3_000.0, 1_500.0],
        [-25_000.0, 6_500.0, 9_000.0],
        [-26_500.0, 9_000.0, 15_500.0],
        [26_000.0, 2_500.0, 2_000.0],
        [25_000.0, 7_000.0, 8_500.0],
        [26_500.0, 9_500.0, 15_000.0],
        [-9_000.0, -5_000.0, 300.0],
        [10_000.0, -6_000.0, 500.0],
    ];
    let references = reference.into_iter().enumerate().map(|(k, xyz)| point(format!("R{}", k + 1), xyz));
    (1..=4).flat_map(row).chain(references).collect()
}

fn camera() -> Camera {
    let mut interior = Interior::brown(24.1);
    for (parameter, value) in [
        (Parameter::X0, 0.03),
        (Parameter::Y0, -0.02),
        (Parameter::K1, -9e-5),
        (Parameter::K2, 1.1e-7),
        (Parameter::P1, 6e-6),
    ] {
        interior.set(parameter, value);
    }
    let free =
        vec![Parameter::C, Parameter::X0, Parameter::Y0, Parameter::K1, Parameter::K2, Parameter::P1, Parameter::P2];
    Camera { pixel_pitch: Some([0.006; 2]), free, ..Camera::new("dam", 6000, 4000, interior) }
}

/// Twelve photos from the valley floor and the slopes, some of them rolled.
fn stations() -> Vec<Station> {
    let station = |k: usize| {
        let along = (k % 6) as f64 - 2.5;
        let high = k >= 6;
        let position = [along * 9_500.0, -34_000.0 - 1_500.0 * along.abs(), if high { 15_000.0 } else { 3_000.0 }];
        let roll = [0.0, std::f64::consts::FRAC_PI_2, 0.0, -std::f64::consts::FRAC_PI_2][k % 4];
        Station::aimed(format!("{}", k + 1), "dam", position, [along * 800.0, 4_000.0, 7_500.0], roll)
    };
    (0..12).map(station).collect()
}

fn adjusted(points: Vec<NetworkPoint>, epoch: usize) -> Result<(Project, Adjustment)> {
    let bar = |from: &str, to: &str| Bar { from: from.into(), to: to.into(), sigma: BAR_MM };
    let ids = points.iter().map(|p| p.id.clone()).collect();
    let project = simulate(&Network {
        name: format!("Dam {}", DATES[epoch]),
        cameras: vec![camera()],
        stations: stations(),
        points,
        distances: vec![bar("R7", "R8"), bar("R1", "R4")],
        // Their datum points are the reference points of the comparison.
        datum: Datum { kind: DatumKind::Free, points: Some(reference()) },
        sigma: Sigma::One(IMAGE_PX),
        seed: 1103 + epoch as u64,
        ..Network::default()
    })?;
    let options = AdjustOptions { covariance_of: ids, ..AdjustOptions::default() };
    let adjustment = adjust(&project, &options, &mut |_| true)?;
    Ok((project, adjustment))
}

/// The epochs, the first one adjusted twice: once for the standard errors by which the others move. `progress` gets how many are done of all,
/// and returns false to cancel.
///
/// # Errors
/// [`crate::Error::Cancelled`]; none besides for this network.
pub fn epochs(progress: &mut dyn FnMut(usize, usize) -> bool) -> Result<Vec<Epoch>> {
    let mut all = Vec::new();
    let mut first: Option<Adjustment> = None;
    for (k, date) in DATES.iter().enumerate() {
        let mut points = points();
        for point in &mut points {
            let sigma = first.iter().flat_map(|a| &a.points).find(|p| p.id == point.id).and_then(|p| p.sigma);
            let Some(sigma) = sigma else { continue };
            let share = k as f64 / (DATES.len() - 1) as f64;
            let by = MOVED.iter().find(|(id, _)| *id == point.id).map(|(_, n)| n * share);
            // Downstream is towards negative Y.
            point.xyz[1] -= by.unwrap_or(0.0) * std::f64::consts::SQRT_2 * sigma[1];
            if point.id == UNSTABLE.0 {
                point.xyz[2] -= UNSTABLE.1 * std::f64::consts::SQRT_2 * sigma[2];
            }
        }
        let (project, adjustment) = adjusted(points, k)?;
        first.get_or_insert_with(|| adjustment.clone());
        let name = project.name.clone();
        let date = Some((*date).to_owned());
        all.push(Epoch { name, date, project: Some(project), adjustment: Some(adjustment), ..Epoch::default() });
        if !progress(k + 1, DATES.len()) {
            return Err(sightline::Error::Cancelled);
        }
    }
    Ok(all)
}

/// The reference points of the sample.
pub fn reference() -> Vec<String> {
    (1..=8).map(|k| format!("R{k}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use sightline::monitoring::{Options, Outcome, compare_epochs};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn what_was_moved_is_found_and_nothing_else() {
        let epochs = epochs(&mut |_, _| true).expect("three epochs");
        let found = compare_epochs(&epochs, &Options::default()).expect("a comparison");
        let last = &found.pairs[1];
        assert_eq!((last.outcome, &last.unstable[..]), (Outcome::StableGroup, &[UNSTABLE.0.to_owned()][..]));
        let moved: Vec<&str> =
            last.points.iter().filter(|p| p.moved && p.id != UNSTABLE.0).map(|p| p.id.as_str()).collect();
        // Ten standard errors are found; three are below what the test finds with certainty.
        assert!(moved.contains(&"D23") && moved.contains(&"D24"), "{moved:?}");
        assert!(moved.iter().all(|id| MOVED.iter().any(|(known, _)| known == id)), "{moved:?}");
        let fast: Vec<_> = found.series.iter().filter(|s| s.velocity_test.is_some_and(|t| t.p < 1e-4)).collect();
        assert!(["D23", "D24"].iter().all(|id| fast.iter().any(|s| s.id == *id)));
        assert!(found.series_datum.len() == 7);
    }
}
