//! What the photos of a camera cover: how far out in the picture targets were measured, and how the camera was turned and tilted.
//!
//! Distortion is only known where targets were measured; a principal point only where the camera was rolled about its axis (D. C. Brown,
//! Close-range camera calibration, 1971); a principal distance of a plane object only where it was tilted against the axis.

use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::error::Result;
use crate::project::Project;
use crate::rotation;

/// Cells of the picture across and down.
const CELLS: [usize; 2] = [8, 6];
/// Rings from the middle to the corner.
const RINGS: usize = 5;
/// Upper ends of the classes of tilts, degrees.
const TILTS: [f64; 3] = [15.0, 30.0, 45.0];
/// Fewest photos: with eight, as many poses as unknowns of a lens are told apart.
const PHOTOS: usize = 8;
/// A radius up to which targets have to be measured, in parts of that of the corner; the rest is extrapolated.
const REACH: f64 = 0.85;
/// Cells without a target, as a part of all, from which on that is told.
const EMPTY: f64 = 0.15;
/// Tilt of some photos without which the principal distance of a plane object is not told from its distance, degrees.
const TILTED: f64 = 20.0;

/// What is missing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum CoverageLack {
    /// Photos: fewer than eight.
    Photos,
    /// Targets towards the corners.
    Radius,
    /// Targets in several parts of the picture.
    Cells,
    /// Photos rolled by 90 degrees about the axis.
    Roll,
    /// Photos tilted against the object.
    Tilt,
}

/// What the photos of a camera cover.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Coverage {
    /// Camera identifier.
    pub camera: String,
    /// Photos with measurements that take part.
    pub photos: usize,
    /// Their measurements.
    pub measurements: usize,
    /// Measurements by rows and columns of cells of the picture.
    pub cells: Vec<Vec<usize>>,
    /// Measurements by rings from the middle to the corner, all as wide.
    pub rings: Vec<usize>,
    /// Radius of the outermost measurement in parts of that of the corner.
    pub reach: f64,
    /// Photos with a known orientation: of these are rolls and tilts.
    pub oriented: usize,
    /// Photos by their roll about the axis against the first one: 0, 90, 180, 270 degrees, each within 45.
    pub rolls: [usize; 4],
    /// Photos by the tilt of their axis against the normal of the points' plane, in classes up to 15, 30, 45 and 90 degrees.
    pub tilts: [usize; 4],
    /// Smallest and largest distance from the points' centroid, in the project's unit; null without orientation.
    pub distances: Option<[f64; 2]>,
    /// What is missing.
    pub lacks: Vec<CoverageLack>,
}

/// What the photos of a camera cover. Orientations and points are those of the document.
///
/// # Errors
/// As [`super::compare_models`] for the camera; whatever [`Project::validate`] finds.
pub fn coverage(project: &Project, camera: Option<&str>) -> Result<Coverage> {
    project.validate()?;
    let camera = super::camera_of(project, camera)?;
    let size = [f64::from(camera.width), f64::from(camera.height)];
    let corner = size[0].hypot(size[1]) / 2.0;
    let mut found = Coverage {
        camera: camera.id.clone(),
        cells: vec![vec![0; CELLS[0]]; CELLS[1]],
        rings: vec![0; RINGS],
        ..Coverage::default()
    };
    let own = project.photos.iter().filter(|p| p.enabled && p.camera == camera.id);
    let mut count: HashMap<&str, usize> = own.map(|p| (p.id.as_str(), 0)).collect();
    for o in project.observations.iter().filter(|o| o.enabled) {
        let Some(count) = count.get_mut(o.photo.as_str()) else { continue };
        *count += 1;
        found.measurements += 1;
        let at = |value: f64, size: f64, n: usize| ((value / size * n as f64).max(0.0) as usize).min(n - 1);
        found.cells[at(o.v, size[1], CELLS[1])][at(o.u, size[0], CELLS[0])] += 1;
        let radius = (o.u - size[0] / 2.0).hypot(o.v - size[1] / 2.0) / corner;
        found.rings[at(radius, 1.0, RINGS)] += 1;
        found.reach = found.reach.max(radius);
    }
    found.photos = count.values().filter(|n| **n > 0).count();
    let places: Vec<Vector3<f64>> = project.points.iter().filter_map(|p| p.xyz).map(Vector3::from).collect();
    let plane = Plane::of(&places);
    let taken = project.photos.iter().filter(|p| count.get(p.id.as_str()).is_some_and(|n| *n > 0));
    let mut first = None;
    let mut most_tilted = 0.0_f64;
    for (position, angles) in taken.filter_map(|p| p.position.zip(p.rotation)) {
        found.oriented += 1;
        let m = rotation::object_to_camera(angles);
        if let Some(plane) = &plane {
            let to_centre = (Vector3::from(position) - plane.centre).norm();
            let [near, far] = found.distances.unwrap_or([to_centre; 2]);
            found.distances = Some([near.min(to_centre), far.max(to_centre)]);
            // the camera looks along its -z
            let tilt = (m.row(2) * plane.normal)[0].abs().min(1.0).acos().to_degrees();
            most_tilted = most_tilted.max(tilt);
            found.tilts[TILTS.iter().filter(|end| tilt > **end).count()] += 1;
            let direction = m * plane.along;
            let roll = direction.y.atan2(direction.x);
            let against = (roll - *first.get_or_insert(roll)).rem_euclid(TAU);
            found.rolls[(against / FRAC_PI_2).round() as usize % 4] += 1;
        }
    }
    found.lacks = lacks(&found, most_tilted, plane.is_some_and(|plane| plane.is_flat));
    Ok(found)
}

fn lacks(found: &Coverage, most_tilted: f64, is_flat: bool) -> Vec<CoverageLack> {
    let empty = found.cells.iter().flatten().filter(|n| **n == 0).count() as f64;
    let known = found.oriented > 1;
    let all = [
        (CoverageLack::Photos, found.photos < PHOTOS),
        (CoverageLack::Radius, found.measurements > 0 && found.reach < REACH),
        (CoverageLack::Cells, found.measurements > 0 && empty > EMPTY * (CELLS[0] * CELLS[1]) as f64),
        (CoverageLack::Roll, known && found.rolls[1] + found.rolls[3] == 0),
        (CoverageLack::Tilt, known && is_flat && most_tilted < TILTED),
    ];
    all.into_iter().filter_map(|(lack, missing)| missing.then_some(lack)).collect()
}

/// The plane that the points lie nearest to.
struct Plane {
    centre: Vector3<f64>,
    normal: Vector3<f64>,
    /// The points' longest extent.
    along: Vector3<f64>,
    /// Whether they reach less than a tenth as far out of it as along it.
    is_flat: bool,
}

impl Plane {
    fn of(places: &[Vector3<f64>]) -> Option<Self> {
        if places.len() < 3 {
            return None;
        }
        let centre = places.iter().sum::<Vector3<f64>>() / places.len() as f64;
        let spread: Matrix3<f64> = places.iter().map(|x| (x - centre) * (x - centre).transpose()).sum();
        let eigen = spread.symmetric_eigen();
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
        let axis = |k: usize| eigen.eigenvectors.column(order[k]).into_owned();
        let is_flat = eigen.eigenvalues[order[0]] < 0.01 * eigen.eigenvalues[order[2]];
        Some(Self { centre, normal: axis(0), along: axis(2), is_flat })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::network::{Network, NetworkPoint, Station, simulate};
    use crate::project::{Camera, Interior};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    /// A flat board of 30 points of `half` a width, seen from stations at a tilt and a roll in degrees.
    fn board(half: f64, stations: &[(f64, f64)]) -> Project {
        let point = |k: u32| NetworkPoint {
            id: k.to_string(),
            xyz: [half * (f64::from(k % 6) / 2.5 - 1.0), half * 0.7 * (f64::from(k / 6) / 2.0 - 1.0), 0.0],
            ..NetworkPoint::default()
        };
        let station = |(k, (tilt, roll)): (usize, &(f64, f64))| {
            let tilt = tilt.to_radians();
            let position = [600.0 * tilt.sin(), 0.0, 600.0 * tilt.cos()];
            Station::aimed(format!("s{k}"), "c", position, [0.0; 3], roll.to_radians())
        };
        simulate(&Network {
            cameras: vec![Camera::new("c", 1600, 1200, Interior::brown(1500.0))],
            stations: stations.iter().enumerate().map(station).collect(),
            points: (0..30).map(point).collect(),
            ..Network::default()
        })
        .expect("a network")
    }

    #[test]
    fn good_coverage_lacks_nothing_and_each_lack_is_told() {
        let turns = [0.0, 90.0, 180.0, 270.0];
        let good: Vec<(f64, f64)> = turns.iter().flat_map(|roll| [(2.0, *roll), (35.0, *roll)]).collect();
        let found = coverage(&board(300.0, &good), None).expect("one camera");
        assert_eq!((found.photos, found.oriented, found.rolls, found.tilts), (8, 8, [2; 4], [4, 0, 4, 0]));
        assert_eq!(found.lacks, [], "{found:?}");
        assert_eq!(found.rings.iter().sum::<usize>(), found.measurements);
        assert_eq!(found.cells.iter().flatten().sum::<usize>(), found.measurements);
        let [near, far] = found.distances.expect("oriented");
        assert!((near - 600.0).abs() < 1.0 && (far - 600.0).abs() < 1.0);
        let lacks = |stations: &[(f64, f64)]| coverage(&board(300.0, stations), None).expect("one camera").lacks;
        let has = |all: &[CoverageLack], roll, tilt| {
            (all.contains(&CoverageLack::Roll), all.contains(&CoverageLack::Tilt)) == (roll, tilt)
        };
        let upright: Vec<(f64, f64)> = good.iter().map(|(tilt, _)| (*tilt, 90.0)).collect();
        assert!(has(&lacks(&upright), true, false), "{:?}", lacks(&upright));
        let frontal: Vec<(f64, f64)> = good.iter().map(|(_, roll)| (3.0, *roll)).collect();
        assert!(has(&lacks(&frontal), false, true), "{:?}", lacks(&frontal));
        let few = coverage(&board(60.0, &good[..3]), None).expect("one").lacks;
        assert_eq!(few, [CoverageLack::Photos, CoverageLack::Radius, CoverageLack::Cells]);
    }

    #[test]
    fn nothing_measured_lacks_photos() {
        let mut bare = board(300.0, &[(0.0, 0.0)]);
        bare.observations = Default::default();
        let found = coverage(&bare, Some("c")).expect("one");
        assert_eq!((found.photos, found.reach, found.lacks), (0, 0.0, vec![CoverageLack::Photos]));
        assert!(coverage(&bare, Some("x")).is_err());
    }
}
