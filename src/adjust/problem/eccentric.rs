//! Eccentricity of circular targets: how far the centre of the ellipse that was measured lies from the image of the
//! circle's centre ([`crate::eccentricity`]), for targets whose diameter the document gives.
//!
//! The circle's normal is given with the point, or is that of the surface it lies on: the plane through the point and its
//! nearest neighbours. The corrections depend so weakly on the unknowns that they are held during an iteration and
//! computed again after it.
//!
//! A plane through n points that lie off it by the rms deviation s (n - 3 degrees of freedom), with rms extents a and b along
//! its axes, has a normal that is uncertain by
//!
//! ```text
//! σ² = s²/n · (1/a² + 1/b²)
//! ```
//!
//! An eccentricity is e = E sin 2α with the angle α between ray and normal, E = c r²/(2Z²) at distance Z; an error of the
//! normal by σ changes it by up to 2Eσ. A surface is believed where that is at most a tenth of E, σ ≤ 1/20: what it leaves
//! is then small beside what it takes away, and points scattered in space, with s as large as a and b, are far from it. Else
//! nothing is corrected.

use nalgebra::{DMatrix, Vector3};
use std::borrow::Cow;

use crate::eccentricity::{Circle, pixels};
use crate::error::{Error, Place, Reason, Result};
use crate::project::{Interior, Project};

use super::network::Network;
use super::state::State;

/// Neighbours that span the surface.
const NEIGHBOURS: usize = 6;
/// Part of the largest eccentricity that the uncertainty of a surface's normal may leave, see above.
const LEFT: f64 = 0.1;

/// The project with this diameter for every target that states none.
///
/// # Errors
/// [`Error::Invalid`] unless the diameter is a finite number above 0 and smaller than what the points extend over: a larger one is
/// in another unit.
pub fn sized(mut project: Cow<'_, Project>, diameter: Option<f64>) -> Result<Cow<'_, Project>> {
    let Some(diameter) = diameter else { return Ok(project) };
    let invalid = |reason| Err(Error::Invalid { reason, at: Place::field("target_diameter") });
    if !(diameter > 0.0 && diameter.is_finite()) {
        return invalid(Reason::CommonDiameter { value: diameter.into() });
    }
    let places = project.points.iter().filter_map(|point| point.xyz);
    let (low, high) = places.fold(([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]), |(low, high), xyz| {
        (std::array::from_fn(|k| low[k].min(xyz[k])), std::array::from_fn(|k| high[k].max(xyz[k])))
    });
    let extent = (0..3).map(|k| (high[k] - low[k]).powi(2)).sum::<f64>().sqrt();
    if extent > 0.0 && diameter > extent {
        return invalid(Reason::DiameterBeyondPoints { value: diameter.into(), extent: extent.into() });
    }
    for point in project.to_mut().points.iter_mut().filter(|point| point.diameter.is_none()) {
        point.diameter = Some(diameter);
    }
    Ok(project)
}

/// Corrections in the units of the residuals, per ray, to be taken off the measurements; empty where no target has a
/// diameter.
pub fn shifts(project: &Project, network: &Network, state: &State) -> Vec<[f64; 2]> {
    let diameter = |k: usize| project.points[network.points[k].index].diameter.filter(|d| *d > 0.0);
    if (0..network.points.len()).all(|k| diameter(k).is_none()) {
        return Vec::new();
    }
    let cameras: Vec<_> = (network.interiors.iter().zip(&state.interiors))
        .map(|(block, interior)| {
            let mut camera = project.cameras[block.camera].clone();
            camera.interior = *interior;
            camera
        })
        .collect();
    let mut shifts = vec![[0.0; 2]; network.rays.len()];
    let sorted = Sorted::new(&state.points);
    for (k, block) in network.points.iter().enumerate() {
        let given = project.points[block.index].normal.and_then(|n| Vector3::from(n).try_normalize(0.0));
        let Some(normal) = diameter(k).and_then(|_| given.or_else(|| sorted.normal(k))) else { continue };
        let diameter = diameter(k).unwrap_or_default() / network.frame.scale;
        for ray in block.rays.clone() {
            let photo = network.rays[ray].photo;
            let camera = &cameras[network.photos[photo].interior];
            let pose = &state.poses[photo];
            let centre = Vector3::from(pose.camera_point(&state.points[k]));
            let circle = Circle { centre, normal: pose.matrix() * normal, diameter };
            let Some([du, dv]) = pixels(camera, &circle) else { continue };
            shifts[ray] = match camera.interior {
                Interior::Brown { .. } => {
                    let pitch = camera.pitch();
                    [du * pitch[0], -dv * pitch[1]]
                }
                Interior::Opencv { .. } => [du, dv],
            };
        }
    }
    shifts
}

/// Largest difference between two sets of corrections, in a priori standard errors.
pub fn difference(network: &Network, a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    let of = |shifts: &[[f64; 2]], k: usize, side: usize| shifts.get(k).map_or(0.0, |s| s[side]);
    let one = |k: usize, side: usize| ((of(a, k, side) - of(b, k, side)) * network.rays[k].weight[side]).abs();
    (0..network.rays.len()).flat_map(|k| [one(k, 0), one(k, 1)]).fold(0.0, f64::max)
}

/// Points in the order of their first coordinate, for finding neighbours.
struct Sorted<'a> {
    points: &'a [[f64; 3]],
    order: Vec<usize>,
    place: Vec<usize>,
}

impl<'a> Sorted<'a> {
    fn new(points: &'a [[f64; 3]]) -> Self {
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_by(|a, b| points[*a][0].total_cmp(&points[*b][0]));
        let mut place = vec![0; points.len()];
        order.iter().enumerate().for_each(|(at, k)| place[*k] = at);
        Self { points, order, place }
    }

    /// The nearest points, nearest first.
    fn neighbours(&self, k: usize) -> Vec<usize> {
        let x = self.points[k];
        let mut found: Vec<(f64, usize)> = Vec::with_capacity(NEIGHBOURS + 1);
        let mut visit = |other: usize| {
            let y = self.points[other];
            let along = (y[0] - x[0]).powi(2);
            if found.len() == NEIGHBOURS && along > found[NEIGHBOURS - 1].0 {
                return false;
            }
            let squared = along + (y[1] - x[1]).powi(2) + (y[2] - x[2]).powi(2);
            let at = found.partition_point(|(d, _)| *d < squared);
            found.insert(at, (squared, other));
            found.truncate(NEIGHBOURS);
            true
        };
        // Outwards on either side, until the first coordinate alone is farther than what was found.
        let (before, after) = self.order.split_at(self.place[k]);
        let _ = before.iter().rev().all(|other| visit(*other));
        let _ = after[1..].iter().all(|other| visit(*other));
        found.into_iter().map(|(_, other)| other).collect()
    }

    /// Normal of the surface at a point; none where its neighbours do not show it well enough.
    fn normal(&self, k: usize) -> Option<Vector3<f64>> {
        self.plane(k).filter(|(_, sigma)| 2.0 * sigma <= LEFT).map(|(normal, _)| normal)
    }

    /// Normal of the plane through a point and its neighbours, and its standard error in radians.
    fn plane(&self, k: usize) -> Option<(Vector3<f64>, f64)> {
        let mut around = self.neighbours(k);
        around.push(k);
        if around.len() < 4 {
            return None;
        }
        let at = |k: usize| Vector3::from(self.points[k]);
        let mean = around.iter().map(|k| at(*k)).sum::<Vector3<f64>>() / around.len() as f64;
        let centred = DMatrix::from_fn(3, around.len(), |a, n| at(around[n])[a] - mean[a]);
        let eigen = nalgebra::SymmetricEigen::try_new(&centred * centred.transpose(), 1e-15, 200)?;
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
        // Sums of squares along the axes: n a², n b², (n - 3) s².
        let [most, middle, least] = order.map(|a| eigen.eigenvalues[a].max(0.0));
        // Rounding alone leaves this of a plane.
        let least = least.max(1e-24 * most) / (around.len() - 3) as f64;
        let normal = eigen.eigenvectors.column(order[2]);
        let squared = least / middle + least / most;
        Some((Vector3::new(normal[0], normal[1], normal[2]), squared.sqrt())).filter(|(_, sigma)| sigma.is_finite())
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;
    use crate::adjust::adjust;
    use crate::adjustment::{AdjustOptions, Adjustment};
    use crate::camera::pixel_from_camera_point;
    use crate::detect::conic;
    use crate::project::{Camera, DatumKind, Observation, Parameter, Photo, Point, Sigma};
    use crate::rotation::{angles, object_to_camera};

    const DIAMETER: f64 = 30.0;

    /// Circles of 30 mm, seen from 1.2 m: centres of the ellipses through their projected rims. On a plate of 1 m, or
    /// scattered above it, each turned another way.
    fn circles(scattered: bool) -> Project {
        let mut project = Project { unit: "mm".into(), ..Project::default() };
        let mut camera = Camera::new("c", 4000, 3000, Interior::brown(20.0));
        camera.pixel_pitch = Some([0.005; 2]);
        camera.free = vec![Parameter::C, Parameter::X0, Parameter::Y0];
        let turn = object_to_camera([0.3, -0.2, 0.1]).transpose();
        for k in 0..25 {
            let height = if scattered { f64::from(k * k % 23) * 20.0 } else { 0.0 };
            let xyz = turn * Vector3::new(f64::from(k % 5 - 2) * 200.0, f64::from(k / 5 - 2) * 200.0, height);
            let tilt = if scattered { 0.5 } else { 0.0 };
            let azimuth = f64::from(k) * 2.4;
            let normal = turn * Vector3::new(tilt * azimuth.cos(), tilt * azimuth.sin(), 1.0) * 3.0;
            project.points.push(Point {
                id: k.to_string(),
                xyz: Some(xyz.into()),
                diameter: Some(DIAMETER),
                normal: Some(normal.into()),
                ..Point::default()
            });
        }
        for k in 0..8 {
            let azimuth = f64::from(k) * 0.785;
            let place = Vector3::new(1000.0 * azimuth.cos(), 1000.0 * azimuth.sin(), 900.0 + 200.0 * f64::from(k % 2));
            let z = place.normalize();
            let x = Vector3::z().cross(&z).normalize();
            let y = z.cross(&x);
            let (x, y) = if k % 2 == 0 { (x, y) } else { (y, -x) };
            let m = nalgebra::Matrix3::from_rows(&[x.transpose(), y.transpose(), z.transpose()]) * turn.transpose();
            let centre = turn * place;
            let id = format!("p{k}");
            for point in &project.points {
                let circle = m * (Vector3::from(point.xyz.expect("given")) - centre);
                let normal = m * Vector3::from(point.normal.expect("given")).normalize();
                let e1 = normal.cross(&Vector3::x()).normalize();
                let e2 = normal.cross(&e1);
                let rim: Vec<[f64; 3]> = (0..24)
                    .map(|k| {
                        let (s, c) = (f64::from(k) * std::f64::consts::TAU / 24.0).sin_cos();
                        let rim = circle + (e1 * c + e2 * s) * (DIAMETER / 2.0);
                        let [u, v] = pixel_from_camera_point(&camera, rim).expect("in front");
                        [u, v, 1.0]
                    })
                    .collect();
                let ellipse = conic::fit(&rim).expect("an ellipse");
                project.observations.push(Observation {
                    photo: id.clone(),
                    point: point.id.clone(),
                    u: ellipse.u,
                    v: ellipse.v,
                    sigma: Sigma::One(0.01),
                    enabled: true,
                    target: None,
                });
            }
            let (position, rotation) = (Some(centre.into()), Some(angles(&m)));
            project.photos.push(Photo {
                id,
                camera: "c".into(),
                position,
                rotation,
                enabled: true,
                ..Photo::default()
            });
        }
        project.cameras.push(camera);
        project.datum.kind = DatumKind::Free;
        project
    }

    /// The same network measured at the images of the centres plus the eccentricity of the closed form, without diameters:
    /// what uncorrected centres must leave in sigma0.
    fn predicted_sigma0(project: &Project) -> f64 {
        let mut predicted = project.clone();
        for observation in &mut predicted.observations {
            let photo = project.photos.iter().find(|p| p.id == observation.photo).expect("known");
            let point = project.points.iter().find(|p| p.id == observation.point).expect("known");
            let m = object_to_camera(photo.rotation.expect("known"));
            let [centre, normal] = [
                m * (Vector3::from(point.xyz.expect("given")) - Vector3::from(photo.position.expect("known"))),
                m * Vector3::from(point.normal.expect("given")),
            ];
            let camera = &project.cameras[0];
            let [du, dv] = pixels(camera, &Circle { centre, normal, diameter: DIAMETER }).expect("seen");
            let [u, v] = pixel_from_camera_point(camera, centre).expect("in front");
            (observation.u, observation.v) = (u + du, v + dv);
        }
        predicted.points.iter_mut().for_each(|point| point.diameter = None);
        solve(&predicted).sigma0.expect("redundant")
    }

    fn solve(project: &Project) -> Adjustment {
        adjust(project, &AdjustOptions::default(), &mut |_| true).expect("solvable")
    }

    /// With their diameters the circles give back c; without, they leave what the closed form predicts.
    fn is_freed(project: &Project) {
        let predicted = predicted_sigma0(project);
        let mut plain = project.clone();
        plain.points.iter_mut().for_each(|point| point.diameter = None);
        let uncorrected = solve(&plain).sigma0.expect("redundant");
        assert!((uncorrected / predicted - 1.0).abs() < 1e-6, "{uncorrected} is not {predicted}");
        let adjustment = solve(project);
        let sigma0 = adjustment.sigma0.expect("redundant");
        assert!(sigma0 < 1e-3 * predicted, "{sigma0} is left of {predicted}");
        let camera = adjustment.cameras[0].camera.interior;
        assert!((camera.get(Parameter::C).expect("c") - 20.0).abs() < 1e-6, "{camera:?}");
    }

    #[test]
    fn projected_circles_give_back_their_centres() {
        let mut project = circles(false);
        is_freed(&project);
        // The neighbours show the plate without being told.
        let told = solve(&project);
        project.points.iter_mut().for_each(|point| point.normal = None);
        let shown = solve(&project);
        assert!(
            (told.sigma0.expect("r") - shown.sigma0.expect("r")).abs() < 1e-6,
            "{:?} {:?}",
            told.sigma0,
            shown.sigma0
        );
    }

    #[test]
    fn one_diameter_stands_for_those_that_are_not_stated() {
        let stated = circles(false);
        let mut project = stated.clone();
        // a target of another size states its own
        project.points.iter_mut().skip(1).for_each(|point| point.diameter = None);
        let options = AdjustOptions { target_diameter: Some(DIAMETER), ..AdjustOptions::default() };
        let adjustment = adjust(&project, &options, &mut |_| true).expect("solvable");
        assert_eq!(adjustment.sigma0, solve(&stated).sigma0);
        project.points[0].diameter = Some(2.0 * DIAMETER);
        let own = adjust(&project, &options, &mut |_| true).expect("solvable");
        assert!(own.sigma0 > adjustment.sigma0.map(|sigma0| 10.0 * sigma0), "{:?}", own.sigma0);
        // the last one is in another unit
        for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY, 1000.0 * DIAMETER] {
            let options = AdjustOptions { target_diameter: Some(wrong), ..AdjustOptions::default() };
            let error = adjust(&project, &options, &mut |_| true).expect_err("no diameter");
            assert!(error.to_string().contains("target_diameter"), "{error}");
        }
    }

    #[test]
    fn targets_that_face_anywhere_are_freed_by_their_own_normals() {
        let mut project = circles(true);
        is_freed(&project);
        // Scattered points show no surface: nothing is corrected, and what is left is predicted.
        let predicted = predicted_sigma0(&project);
        project.points.iter_mut().for_each(|point| point.normal = None);
        let left = solve(&project).sigma0.expect("redundant");
        assert!((left / predicted - 1.0).abs() < 1e-6, "{left} {predicted}");
    }

    /// Scatter of the normals of noisy planes against their stated standard errors.
    #[test]
    fn normals_of_surfaces_scatter_as_stated() {
        let mut noise = crate::noise::Noise::new(7, 0);
        for (along, across, off) in [(1.0, 1.0, 0.01), (1.0, 0.4, 0.005), (3.0, 1.0, 0.02)] {
            let (mut squares, mut stated) = (0.0, 0.0);
            for _ in 0..4000 {
                let place = |k: u32| [along * f64::from(k % 4), across * f64::from(k * 3 % 7)];
                let points: Vec<[f64; 3]> = (0..7).map(place).map(|[x, y]| [x, y, off * noise.normal()]).collect();
                let (normal, sigma) = Sorted::new(&points).plane(3).expect("seven points");
                squares += normal.x * normal.x + normal.y * normal.y;
                stated += sigma * sigma;
            }
            // Both sums have about 4000 × 2 degrees of freedom or more: a ratio within 1 ± 4 √(2/8000 · 2).
            let ratio = squares / stated;
            assert!((ratio - 1.0).abs() < 0.1, "{along} {across} {off}: {ratio}");
        }
        // A cloud without a surface is hardly ever taken for one.
        let believed = (0..2000).filter(|_| {
            let points: Vec<[f64; 3]> = (0..7).map(|_| [(); 3].map(|()| noise.normal())).collect();
            Sorted::new(&points).normal(3).is_some()
        });
        let believed = believed.count();
        assert!(believed < 10, "{believed} of 2000");
    }

    #[test]
    fn a_normal_comes_from_a_flat_neighbourhood_only() {
        let flat: Vec<[f64; 3]> =
            (0..9).map(|k| [f64::from(k % 3), f64::from(k / 3), 0.5 * f64::from(k % 3)]).collect();
        let normal = Sorted::new(&flat).normal(4).expect("flat");
        assert!((normal.dot(&Vector3::new(-0.5, 0.0, 1.0).normalize()).abs() - 1.0).abs() < 1e-12);
        let mut bent = flat.clone();
        bent[0][2] += 1.0;
        bent[1][2] -= 0.6;
        assert_eq!(Sorted::new(&bent).normal(4), None);
        let line: Vec<[f64; 3]> = (0..9).map(|k| [f64::from(k), 2.0 * f64::from(k), 0.0]).collect();
        assert_eq!(Sorted::new(&line).normal(4), None);
    }
}
