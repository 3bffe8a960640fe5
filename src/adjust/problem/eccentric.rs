//! Eccentricity of circular targets: how far the centre of the ellipse that was measured lies from the image of the
//! circle's centre ([`crate::eccentricity`]), for targets whose diameter the document gives.
//!
//! The circle's normal is given with the point, or is that of the surface it lies on ([`super::surface`]). The corrections
//! depend so weakly on the unknowns that they are held during an iteration and computed again after it.
//!
//! An eccentricity is e = E sin 2α with the angle α between ray and normal, E = c r²/(2Z²) at distance Z; an error of the
//! normal by σ changes it by up to 2Eσ. A surface is accepted if that is at most a tenth of E, σ ≤ 1/20: what it leaves
//! is then small beside what it takes away, and points scattered in space are far from it.
//!
//! Corrections of some points and not of their neighbours bend the object, which is worse than none: points that are each other's
//! neighbours are one group, and all of it is corrected or nothing. A group counts as a surface where nine tenths of its normals
//! are accepted and the others, at its rim, leave at most half of E.

use nalgebra::Vector3;
use std::borrow::Cow;

use crate::adjustment::PointEccentricity;
use crate::eccentricity::{TargetCircle, pixels};
use crate::error::{Error, Place, Reason, Result};
use crate::project::{Camera, Project};

use super::network::Network;
use super::state::State;
use super::surface::Surface;

/// Part of the largest eccentricity that the uncertainty of a surface's normal may leave, see above.
const LEFT: f64 = 0.1;
/// The same at the rim of a surface, and the share of a group whose normals must be accepted.
const LEFT_AT_THE_RIM: f64 = 0.5;
const BELIEVED: f64 = 0.9;

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

/// Corrections in the units of the residuals, per ray, to be taken off the measurements; empty if no target has a
/// diameter.
pub fn shifts(project: &Project, network: &Network, state: &State) -> Vec<[f64; 2]> {
    let diameter = |k: usize| project.points[network.points[k].index].diameter.filter(|d| *d > 0.0);
    if (0..network.points.len()).all(|k| diameter(k).is_none()) {
        return Vec::new();
    }
    let cameras: Vec<_> = (network.interiors.iter().zip(&state.interiors))
        .map(|(block, &interior)| Camera { interior, ..project.cameras[block.camera].clone() })
        .collect();
    let mut shifts = vec![[0.0; 2]; network.rays.len()];
    let normals = normals(project, network, state);
    for (k, block) in network.points.iter().enumerate() {
        let Some(normal) = normals[k] else { continue };
        let diameter = diameter(k).unwrap_or_default() / network.frame.scale;
        for ray in block.rays.clone() {
            let photo = network.rays[ray].photo;
            let camera = &cameras[network.photos[photo].interior];
            let pose = &state.poses[photo];
            let centre = Vector3::from(pose.camera_point(&state.points[k]));
            let circle = TargetCircle { centre, normal: pose.matrix() * normal, diameter };
            let Some([du, dv]) = pixels(camera, &circle) else { continue };
            let pitch = camera.residual_pitch();
            let down = if camera.interior.model().in_photo_units { -1.0 } else { 1.0 };
            shifts[ray] = [du * pitch[0], down * dv * pitch[1]];
        }
    }
    shifts
}

/// Largest difference between two sets of corrections, in a priori standard errors.
pub fn difference(network: &Network, a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    let of = |shifts: &[[f64; 2]], k: usize, side: usize| shifts.get(k).map_or(0.0, |s| s[side]);
    let one = |k: usize, side: usize| ((of(a, k, side) - of(b, k, side)) * network.rays[k].sqrt_weight[side]).abs();
    (0..network.rays.len()).flat_map(|k| [one(k, 0), one(k, 1)]).fold(0.0, f64::max)
}

/// Normals of the points with a diameter: given, or that of the surface where their group shows one. Targets show it among
/// themselves, since other points need not lie on it; where they are too few, with all others.
fn normals(project: &Project, network: &Network, state: &State) -> Vec<Option<Vector3<f64>>> {
    let mut normals = vec![None; network.points.len()];
    let (mut target, mut open) = (vec![false; network.points.len()], vec![false; network.points.len()]);
    for (k, block) in network.points.iter().enumerate() {
        let point = &project.points[block.index];
        if point.diameter.is_some_and(|d| d > 0.0) {
            normals[k] = point.normal.and_then(|n| Vector3::from(n).try_normalize(0.0));
            (target[k], open[k]) = (true, normals[k].is_none());
        }
    }
    let targets = Surface::of(&state.points, |k| target[k]);
    let everything = Surface::new(&state.points);
    for group in groups(&targets, &open) {
        let found = [&targets, &everything].into_iter().find_map(|surface| believed(surface, &group));
        group.iter().zip(found.into_iter().flatten()).for_each(|(k, normal)| normals[*k] = Some(normal));
    }
    normals
}

/// Normals of all points of a group, if the surface shows them.
fn believed(surface: &Surface<'_>, group: &[usize]) -> Option<Vec<Vector3<f64>>> {
    let found: Vec<(Vector3<f64>, f64)> = group.iter().map(|k| surface.normal(*k)).collect::<Option<_>>()?;
    let within = |left: f64| found.iter().filter(|(_, sigma)| 2.0 * sigma <= left).count();
    let shown = within(LEFT) as f64 >= BELIEVED * group.len() as f64 && within(LEFT_AT_THE_RIM) == group.len();
    shown.then(|| found.into_iter().map(|(normal, _)| normal).collect())
}

/// Points without a normal of their own that are joined by chains of neighbours.
fn groups(surface: &Surface<'_>, open: &[bool]) -> Vec<Vec<usize>> {
    let mut joined = vec![Vec::new(); open.len()];
    for k in (0..open.len()).filter(|k| open[*k]) {
        for other in surface.nearest(k).into_iter().filter(|other| open[*other]) {
            joined[k].push(other);
            joined[other].push(k);
        }
    }
    let mut seen = vec![false; open.len()];
    let mut groups = Vec::new();
    for start in (0..open.len()).filter(|k| open[*k]) {
        if std::mem::replace(&mut seen[start], true) {
            continue;
        }
        let (mut group, mut next) = (vec![start], 0);
        while let Some(&k) = group.get(next) {
            next += 1;
            for &other in &joined[k] {
                if !std::mem::replace(&mut seen[other], true) {
                    group.push(other);
                }
            }
        }
        groups.push(group);
    }
    groups
}

/// Correction of the eccentricity of every point with a diameter: the largest correction of its rays, none where its normal
/// is not known.
pub fn eccentricities(project: &Project, network: &Network, shift: &[[f64; 2]]) -> Vec<PointEccentricity> {
    let mut told = Vec::new();
    for block in &network.points {
        let point = &project.points[block.index];
        if point.diameter.is_none_or(|d| d <= 0.0) {
            continue;
        }
        let length = |ray: usize| {
            let camera = &project.cameras[network.interiors[network.photos[network.rays[ray].photo].interior].camera];
            let pitch = camera.residual_pitch();
            shift.get(ray).map_or(0.0, |s| (s[0] / pitch[0]).hypot(s[1] / pitch[1]))
        };
        let largest = block.rays.clone().map(length).fold(0.0, f64::max);
        told.push(PointEccentricity { point: point.id.clone(), correction_px: (largest > 0.0).then_some(largest) });
    }
    told
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
    use crate::project::Interior;
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
            let [du, dv] = pixels(camera, &TargetCircle { centre, normal, diameter: DIAMETER }).expect("seen");
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
                let (normal, sigma) = Surface::new(&points).plane(3).expect("seven points");
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
            Surface::new(&points).plane(3).is_some_and(|(_, sigma)| 2.0 * sigma <= LEFT)
        });
        let believed = believed.count();
        assert!(believed < 10, "{believed} of 2000");
    }

    /// Points of a half sphere, rim included: every normal is that of the sphere, and all of them are accepted.
    #[test]
    fn a_dome_shows_its_normals_to_the_rim() {
        for count in [60, 600] {
            let points: Vec<[f64; 3]> = (0..count)
                .map(|k| {
                    let z = (f64::from(k) + 0.5) / f64::from(count);
                    let (sin, cos) = (2.399_963_23 * f64::from(k)).sin_cos();
                    let radius = (1.0 - z * z).sqrt();
                    [radius * cos, radius * sin, z]
                })
                .collect();
            let surface = Surface::new(&points);
            let found: Vec<(Vector3<f64>, f64)> =
                (0..points.len()).map(|k| surface.normal(k).expect("a surface")).collect();
            let off = |k: usize| found[k].0.dot(&Vector3::from(points[k])).abs().min(1.0).acos();
            let worst = (0..points.len()).map(off).fold(0.0, f64::max);
            assert!(worst < if count == 60 { 0.12 } else { 0.02 }, "{count}: {worst}");
            let believed = found.iter().filter(|(_, sigma)| 2.0 * sigma <= LEFT).count();
            assert!(believed as f64 >= BELIEVED * points.len() as f64, "{believed} of {count}");
            assert!(found.iter().all(|(_, sigma)| 2.0 * sigma <= LEFT_AT_THE_RIM), "{count}");
        }
    }

    #[test]
    fn a_normal_comes_from_a_flat_neighbourhood_only() {
        let flat: Vec<[f64; 3]> =
            (0..9).map(|k| [f64::from(k % 3), f64::from(k / 3), 0.5 * f64::from(k % 3)]).collect();
        let normal = Surface::new(&flat).plane(4).expect("flat").0;
        assert!((normal.dot(&Vector3::new(-0.5, 0.0, 1.0).normalize()).abs() - 1.0).abs() < 1e-12);
        let mut bent = flat.clone();
        bent[0][2] += 1.0;
        bent[1][2] -= 0.6;
        assert!(Surface::new(&bent).plane(4).is_none_or(|(_, sigma)| 2.0 * sigma > LEFT));
        let line: Vec<[f64; 3]> = (0..9).map(|k| [f64::from(k), 2.0 * f64::from(k), 0.0]).collect();
        assert!(Surface::new(&line).normal(4).is_none_or(|(_, sigma)| 2.0 * sigma > LEFT));
    }
}
