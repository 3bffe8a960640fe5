//! The paper's points (table 3-2), base lines (table 3-1) and combinations (table 4-1).

use std::f64::consts::FRAC_PI_2;

use super::super::ExperimentOptions;
use sightline::project::{Camera, Datum, DatumKind, Interior, Role, Sigma};
use sightline_plan::network::{Network, NetworkPoint, Station};

/// Object distances in metres.
pub const DISTANCES: [f64; 5] = [1.4, 1.8, 2.5, 4.0, 7.0];
/// Focusing rings in mm, distance by distance: the principal distance is 99.5 mm and the ring.
const RINGS: [f64; 5] = [7.31, 5.5, 3.78, 2.18, 1.06];
/// Half base lines in mm at B/D of 0.2, 0.3, 0.4.
const HALF_BASES: [[f64; 3]; 5] = [
    [150.679, 226.018, 301.357],
    [197.068, 295.602, 394.136],
    [278.262, 417.393, 556.524],
    [455.222, 678.333, 904.444],
    [800.199, 1200.298, 1600.398],
];
/// First digit of the photo numbers, distance by distance.
const TENS: [usize; 5] = [0, 2, 3, 4, 5];
/// Combinations of distances.
pub const MIXED: [(&str, &str); 16] = [
    ("H", "00 33 34"),
    ("I", "03 04 30"),
    ("J", "00 30 33 34"),
    ("K", "00 03 04 30"),
    ("L", "03 04 33 34"),
    ("M", "00 23 24 33 34"),
    ("N", "03 04 23 24 30"),
    ("O", "03 04 20 33 34"),
    ("H'", "00 53 54"),
    ("I'", "03 04 50"),
    ("J'", "00 50 53 54"),
    ("K'", "00 03 04 50"),
    ("L'", "03 04 53 54"),
    ("M'", "00 43 44 53 54"),
    ("N'", "03 04 43 44 50"),
    ("O'", "03 04 40 53 54"),
];
const POINTS: [[f64; 3]; 15] = [
    [3042.10, 6976.71, 863.59],
    [3012.60, 7058.26, 764.90],
    [3118.42, 7102.89, 760.25],
    [3109.13, 7061.32, 664.96],
    [2992.25, 7026.83, 643.28],
    [3052.76, 7087.83, 549.21],
    [3101.41, 7106.98, 483.54],
    [2940.46, 7055.27, 439.08],
    [3092.89, 7008.81, 376.04],
    [2942.23, 7042.61, 266.89],
    [3090.09, 6920.12, 212.96],
    [2932.22, 7091.17, 66.63],
    [3155.24, 7013.65, -50.79],
    [2960.39, 7166.85, -64.97],
    [2911.12, 6999.10, -147.71],
];
const CONTROL: [usize; 3] = [5, 10, 13];
/// Millimetres per pixel of the grid that represents the plate; no result depends on it.
pub const PITCH_MM: f64 = 0.01;
/// Half the plate, in pixels of that grid: 127 x 102 mm.
const PLATE: [u32; 2] = [12_700, 10_200];

/// One combination of photos.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// Distance in metres; `None` for mixed distances.
    pub distance: Option<f64>,
    /// Type: A, B, C, or the letter of the combination.
    pub kind: String,
    /// Photo numbers.
    pub photos: Vec<String>,
}

impl Case {
    /// `1.4-5A`, or the letter of a combination.
    pub fn name(&self) -> String {
        self.distance.map_or(self.kind.clone(), |d| format!("{d:.1}-{}{}", self.photos.len(), self.kind))
    }
}

/// The 60 networks at one distance.
pub fn single() -> Vec<Case> {
    let mut cases = Vec::new();
    for (i, distance) in DISTANCES.into_iter().enumerate() {
        let number = |units: usize| format!("{}{units}", TENS[i]);
        let pair = |base: usize| [number(2 * base + 1), number(2 * base + 2)];
        for photos in 2..=5 {
            for (kind, one, two) in [("A", 0, 1), ("B", 0, 2), ("C", 1, 2)] {
                let index = ["A", "B", "C"].iter().position(|k| *k == kind).unwrap_or(0);
                let mut numbers = if photos % 2 == 1 { vec![number(0)] } else { Vec::new() };
                if photos < 4 {
                    numbers.extend(pair(index));
                } else {
                    numbers.extend(pair(one).into_iter().chain(pair(two)));
                }
                cases.push(Case { distance: Some(distance), kind: kind.into(), photos: numbers });
            }
        }
    }
    cases
}

/// The 16 networks of mixed distances.
pub fn mixed() -> Vec<Case> {
    let case = |(kind, photos): (&str, &str)| Case {
        distance: None,
        kind: kind.into(),
        photos: photos.split(' ').map(str::to_owned).collect(),
    };
    MIXED.into_iter().map(case).collect()
}

/// All photos at once, for drawing.
pub fn everything() -> Case {
    let photos = TENS.iter().flat_map(|tens| (0..=6).map(move |units| format!("{tens}{units}"))).collect();
    Case { distance: None, kind: "all".into(), photos }
}

/// Projection centre of a photo.
fn centre(number: &str) -> ([f64; 3], usize) {
    let digit = |k: usize| number.as_bytes().get(k).map_or(0, |d| usize::from(d - b'0'));
    let index = TENS.iter().position(|tens| *tens == digit(0)).unwrap_or(0);
    let mean = [0, 1, 2].map(|k| POINTS.iter().map(|p| p[k]).sum::<f64>() / POINTS.len() as f64);
    let offset = match digit(1) {
        0 => 0.0,
        // Odd numbers lie right of the centre, even ones left.
        units if units % 2 == 1 => HALF_BASES[index][units / 2],
        units => -HALF_BASES[index][units / 2 - 1],
    };
    ([mean[0] + offset, mean[1] - 1000.0 * DISTANCES[index], mean[2]], index)
}

/// A combination as a network.
pub fn network(case: &Case, options: &ExperimentOptions) -> Network {
    let camera = |index: usize| Camera {
        pixel_pitch: Some([PITCH_MM; 2]),
        ..Camera::new(format!("p31-{}", DISTANCES[index]), PLATE[0], PLATE[1], Interior::brown(99.5 + RINGS[index]))
    };
    let mut used: Vec<usize> = case.photos.iter().map(|number| centre(number).1).collect();
    used.sort_unstable();
    used.dedup();
    let control_sigma = options.control_sigma_mm.unwrap_or(0.001);
    let point = |(k, xyz): (usize, &[f64; 3])| {
        let control = CONTROL.contains(&(k + 1));
        NetworkPoint {
            id: (k + 1).to_string(),
            role: if control { Role::Control } else { Role::Tie },
            xyz: *xyz,
            sigma: control.then_some([Some(control_sigma); 3]),
            ..NetworkPoint::default()
        }
    };
    let station = |number: &String| {
        let (position, index) = centre(number);
        Station {
            id: number.clone(),
            camera: format!("p31-{}", DISTANCES[index]),
            position,
            // The paper's ω = φ = κ = 0 looks along +Y.
            rotation: Some([FRAC_PI_2, 0.0, 0.0]),
            ..Station::default()
        }
    };
    Network {
        name: format!("Kang & Yeu 1985, {}", case.name()),
        cameras: used.into_iter().map(camera).collect(),
        stations: case.photos.iter().map(station).collect(),
        points: POINTS.iter().enumerate().map(point).collect(),
        datum: Datum { kind: DatumKind::Control, points: None },
        sigma: Sigma::One(options.image_sigma_um.unwrap_or(3.0) / 1000.0 / PITCH_MM),
        seed: options.seed,
        ..Network::default()
    }
}
