//! From nothing to initial values: control fields, free networks, what cannot be oriented.

use crate::support::data::text;
use nalgebra::Vector3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use sightline::adjust::{adjust, apply};
use sightline::adjustment::{AdjustOptions, Adjustment, ResidualPlace, StatisticsChoice, Termination};
use sightline::camera::pixel_from_camera_point;
use sightline::error::{Error, Lack};
use sightline::initial::Pose;
use sightline::initial::similarity::{SimilarityFit, fit};
use sightline::matching::without_gross_errors;
use sightline::orient::{Note, Oriented, PhotoReason, PointReason, ScaleSource, orient};
use sightline::project::{Camera, Distance, Interior, Observation, Parameter, Photo, Point, Project, Role, Sigma};
use sightline::rotation;

pub fn uniform(g: &mut ChaCha8Rng) -> f64 {
    2.0 * ((g.next_u64() >> 11) as f64 / (1u64 << 53) as f64) - 1.0
}

fn gauss(g: &mut ChaCha8Rng) -> f64 {
    (0..12).map(|_| uniform(g)).sum::<f64>() / 2.0
}

pub fn camera(id: &str, c: f64) -> Camera {
    let free = vec![Parameter::C, Parameter::X0, Parameter::Y0, Parameter::K1];
    Camera { free, ..Camera::new(id, 3000, 2000, Interior::brown(c)) }
}

/// A random strong network: `photos` convergent, rolled photos all around a half sphere, `points` in a flat or round
/// object of size 2; the truth is in the positions, rotations and coordinates.
pub fn network(seed: u64, photos: usize, points: usize, flat: f64, noise_px: f64) -> Project {
    let mut g = ChaCha8Rng::seed_from_u64(seed);
    let mut project =
        Project { cameras: vec![camera("k", 2400.0 * (1.0 + 0.25 * uniform(&mut g)))], ..Project::default() };
    if let Interior::Brown { k1, x0, .. } = &mut project.cameras[0].interior {
        (*k1, *x0) = (2e-9 * uniform(&mut g), 10.0 * uniform(&mut g));
    }
    for k in 0..points {
        let xyz = [uniform(&mut g), uniform(&mut g), flat * uniform(&mut g)];
        project.points.push(Point { id: format!("p{k}"), xyz: Some(xyz), ..Point::default() });
    }
    for k in 0..photos {
        let (azimuth, zenith) =
            (std::f64::consts::TAU * (k as f64 + 0.3 * uniform(&mut g)) / photos as f64, 0.55 + 0.25 * uniform(&mut g));
        let distance = 4.5 + 0.5 * uniform(&mut g);
        let direction = Vector3::new(zenith.sin() * azimuth.cos(), zenith.sin() * azimuth.sin(), zenith.cos());
        let x = Vector3::z().cross(&direction).normalize();
        let level =
            nalgebra::Matrix3::from_rows(&[x.transpose(), direction.cross(&x).transpose(), direction.transpose()]);
        let m = rotation::turned(
            &level,
            Vector3::new(0.05 * uniform(&mut g), 0.05 * uniform(&mut g), 1.6 * (k % 4) as f64),
        );
        let pose = Pose { object_to_camera: m, centre: direction * distance };
        let id = format!("photo{k}");
        for point in &project.points {
            let p = pose.to_camera(&point.xyz.expect("truth").into());
            let Some([u, v]) = pixel_from_camera_point(&project.cameras[0], p) else { continue };
            if uniform(&mut g) < -0.7 || u < 0.0 || v < 0.0 || u > 3000.0 || v > 2000.0 {
                continue;
            }
            let (u, v) = (u + noise_px * gauss(&mut g), v + noise_px * gauss(&mut g));
            project.observations.push(Observation {
                photo: id.clone(),
                point: point.id.clone(),
                u,
                v,
                sigma: Sigma::One(noise_px.max(0.01)),
                enabled: true,
                target: None,
            });
        }
        project.photos.push(Photo {
            id,
            camera: "k".into(),
            position: Some(pose.centre.into()),
            rotation: Some(rotation::angles(&m)),
            enabled: true,
            ..Photo::default()
        });
    }
    project
}

/// The network without anything that orientation is to find.
pub fn bare(truth: &Project) -> Project {
    let mut project = truth.clone();
    for camera in &mut project.cameras {
        if let Interior::Brown { c, x0, y0, k1, .. } = &mut camera.interior {
            (*c, *x0, *y0, *k1) = (None, 0.0, 0.0, 0.0);
        }
    }
    for photo in &mut project.photos {
        (photo.position, photo.rotation) = (None, None);
    }
    for point in project.points.iter_mut().filter(|p| p.role == Role::Tie) {
        point.xyz = None;
    }
    project
}

fn points_fit(project: &Project, truth: &Project) -> SimilarityFit {
    let pairs = project
        .points
        .iter()
        .zip(&truth.points)
        .filter_map(|(p, t)| Some((Vector3::from(p.xyz?), Vector3::from(t.xyz?))));
    let (source, target): (Vec<Vector3<f64>>, Vec<Vector3<f64>>) = pairs.unzip();
    fit(&source, &target).expect("enough points")
}

fn adjusted(project: &Project) -> Adjustment {
    let options = AdjustOptions { statistics: StatisticsChoice::None, ..AdjustOptions::default() };
    let adjustment = adjust(project, &options, &mut |_| true).expect("a solvable network");
    assert_eq!(adjustment.termination, Termination::Converged);
    adjustment
}

pub fn all_oriented(oriented: &Oriented) -> bool {
    oriented.project.photos.iter().all(|p| p.position.is_some() && p.rotation.is_some())
}

/// Marks of a list "photo, point, u, v, sigma" as observations, and the points in order of appearance.
fn marks(project: &mut Project, list: &str, sigma_px: f64, point_first: bool) {
    for line in list.lines().map(str::trim).filter(|l| !l.is_empty() && !l.starts_with('#')) {
        let fields: Vec<&str> = line.split(',').map(str::trim).collect();
        let (photo, point) = if point_first { (fields[1], fields[0]) } else { (fields[0], fields[1]) };
        if !project.points.iter().any(|p| p.id == point) {
            project.points.push(Point { id: point.into(), ..Point::default() });
        }
        project.observations.push(Observation {
            photo: photo.into(),
            point: point.into(),
            u: fields[2].parse().expect("a number"),
            v: fields[3].parse().expect("a number"),
            sigma: Sigma::One(sigma_px),
            enabled: true,
            target: None,
        });
    }
}

pub fn camcal(c: Option<f64>) -> Option<Project> {
    let mut project = Project::default();
    let (width, height) = (2272, 1704);
    let pitch = 5.43764 / f64::from(height);
    let mut camera = camera("olympus", 1.0);
    (camera.width, camera.height, camera.pixel_pitch) = (width, height, Some([pitch, pitch]));
    if let Interior::Brown { c: value, .. } = &mut camera.interior {
        *value = c;
    }
    camera.free = Parameter::BROWN.iter().copied().filter(|p| *p != Parameter::B2).collect();
    project.cameras.push(camera);
    for (k, xyz) in [[0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0; 3], [1.0, 0.0, 0.0]].into_iter().enumerate() {
        let id = (1001 + k).to_string();
        project.points.push(Point { id, role: Role::Control, xyz: Some(xyz), ..Point::default() });
    }
    marks(&mut project, &text("camcal/markpts.txt")?, 0.1, false);
    for k in 1..=21 {
        project.photos.push(Photo { id: k.to_string(), camera: "olympus".into(), enabled: true, ..Photo::default() });
    }
    project.datum.kind = sightline::project::DatumKind::Control;
    Some(project)
}

#[test]
fn camcal_is_oriented_and_adjusted_from_nothing() {
    // Unknown, too short and too long principal distances, as picture files tell them.
    for c in [None, Some(7.1), Some(8.2)] {
        let Some(project) = camcal(c) else { return };
        let oriented = orient(&project).expect("a valid project");
        assert!(all_oriented(&oriented), "c {c:?}: {:?}", oriented.notes);
        // The published sigma0 is that of residuals at the corrected place.
        let (residuals, statistics) = (ResidualPlace::Corrected, StatisticsChoice::None);
        let options = AdjustOptions { residuals, statistics, ..AdjustOptions::default() };
        let adjustment = adjust(&oriented.project, &options, &mut |_| true).expect("solvable");
        assert_eq!(adjustment.termination, Termination::Converged);
        let found = adjustment.cameras[0].camera.interior.get(Parameter::C).expect("a value");
        assert!((found - 7.457).abs() < 0.003, "c {c:?} became {found}");
        let sigma0 = adjustment.sigma0.expect("redundant");
        assert!((sigma0 - 1.6148).abs() < 0.016, "c {c:?}: sigma0 {sigma0}");
        println!(
            "camcal from c {c:?}: c {found:.5} mm, sigma0 {sigma0:.4}, {} iterations",
            adjustment.iterations.len()
        );
    }
}

pub fn sxb() -> Option<Project> {
    let mut project = Project { unit: "m".into(), ..Project::default() };
    let mut camera = camera("aerial", 123.9392);
    (camera.width, camera.height, camera.pixel_pitch) = (8858, 12996, Some([53.148 / 8858.0, 77.976 / 12996.0]));
    if let Interior::Brown { x0, y0, .. } = &mut camera.interior {
        (*x0, *y0) = (26.577 - 53.148 / 2.0, 77.976 / 2.0 - 38.811);
    }
    camera.free.clear();
    project.cameras.push(camera);
    for line in text("sxb/reference/sxb-control.txt")?.lines().filter(|l| !l.starts_with('#')) {
        let fields: Vec<&str> = line.split(',').map(str::trim).collect();
        let number = |k: usize| fields[k].parse::<f64>().expect("a number");
        project.points.push(Point {
            id: fields[0].into(),
            role: if ["351", "410"].contains(&fields[0]) { Role::Check } else { Role::Control },
            xyz: Some([number(2), number(3), number(4)]),
            sigma: Some([Some(number(5)), Some(number(6)), Some(number(7))]),
            ..Point::default()
        });
    }
    marks(&mut project, &text("sxb/measurements/markpts.txt")?, 0.5, true);
    marks(&mut project, &text("sxb/measurements/smartpts.txt")?, 1.0, true);
    for k in 1..=5 {
        project.photos.push(Photo { id: k.to_string(), camera: "aerial".into(), enabled: true, ..Photo::default() });
    }
    project.datum.kind = sightline::project::DatumKind::Control;
    Some(project)
}

#[test]
fn the_aerial_block_is_oriented_from_its_control() {
    let Some(project) = sxb() else { return };
    let oriented = orient(&project).expect("a valid project");
    assert!(all_oriented(&oriented), "{:?}", oriented.notes);
    let adjustment = adjusted(&oriented.project);
    let sigma0 = adjustment.sigma0.expect("redundant");
    println!("sxb: sigma0 {sigma0:.4}, redundancy {}", adjustment.redundancy);
    assert!((sigma0 - 1.1786).abs() < 0.0118, "{sigma0}");
    assert_eq!(adjustment.redundancy, 1261);
}

/// The principal distance comes from the images alone, round and flat objects in turns.
#[test]
fn free_networks_reach_the_right_minimum_from_nothing() {
    let mut failed = Vec::new();
    let runs = 16;
    for seed in 0..runs {
        let truth = network(seed, 8, 40, if seed % 2 == 0 { 0.6 } else { 0.02 }, 0.2);
        let oriented = orient(&bare(&truth)).expect("a valid project");
        if !all_oriented(&oriented) {
            failed.push((seed, "not oriented"));
            continue;
        }
        let adjustment = adjusted(&oriented.project);
        let fitted = points_fit(&apply(&oriented.project, &adjustment), &truth);
        // σ0 of 1 within five of its standard errors, √(1/2r); points within 0.5 px at the object.
        let spread = 5.0 * (0.5 / adjustment.redundancy as f64).sqrt();
        if !((adjustment.sigma0.expect("redundant") - 1.0).abs() < spread && fitted.sigma0.expect("redundant") < 1e-3) {
            failed.push((seed, "another minimum"));
        }
    }
    println!("free networks: {} of {runs} right", runs as usize - failed.len());
    assert!(failed.is_empty(), "{failed:?}");
}

#[test]
fn wrong_names_are_found_and_taken_out() {
    for seed in 50..54 {
        let truth = network(seed, 8, 40, 0.5, 0.2);
        let mut project = bare(&truth);
        let mut g = ChaCha8Rng::seed_from_u64(seed);
        let mut wrong = std::collections::BTreeSet::new();
        while wrong.len() < project.observations.len() / 30 {
            let k = (project.observations.len() as f64 * 0.4999 * (uniform(&mut g) + 1.0)) as usize;
            if wrong.insert(k) {
                project.observations[k].u += 150.0 + 300.0 * uniform(&mut g).abs();
            }
        }
        let oriented = orient(&project).expect("a valid project");
        assert!(all_oriented(&oriented), "seed {seed}: {:?}", oriented.notes);
        let cleaned =
            without_gross_errors(&oriented.project, &AdjustOptions::default(), &mut |_| true).expect("solvable");
        let off: Vec<usize> =
            (0..project.observations.len()).filter(|&k| !cleaned.project.observations[k].enabled).collect();
        assert!(wrong.iter().all(|k| off.contains(k)), "seed {seed}: {wrong:?} against {off:?}");
        // A point left with two rays, one of them wrong, loses both.
        assert!(off.len() <= wrong.len() + 2, "seed {seed}: {wrong:?} against {off:?}");
        assert!((cleaned.adjustment.sigma0.expect("redundant") - 1.0).abs() < 0.2);
    }
}

#[test]
fn control_too_sparse_for_any_photo_still_gives_the_system() {
    let truth = network(70, 8, 40, 0.6, 0.2);
    let mut project = bare(&truth);
    let shift = Vector3::new(4000.0, 7000.0, 100.0);
    for k in 0..4 {
        let xyz = Vector3::from(truth.points[k].xyz.expect("truth")) * 10.0 + shift;
        (project.points[k].role, project.points[k].xyz) = (Role::Control, Some(xyz.into()));
    }
    // Each control point in two photos only: two of them in the first ones that show them, two in the last ones.
    for (k, id) in ["p0", "p1", "p2", "p3"].into_iter().enumerate() {
        let rays = project.observations.iter().filter(|o| o.point == id).count();
        let mut n = 0;
        project.observations.retain(|o| {
            n += usize::from(o.point == id);
            o.point != id || if k < 2 { n <= 2 } else { n > rays - 2 }
        });
    }
    let known = |photo: &Photo| {
        let here = project.observations.iter().filter(|o| o.photo == photo.id);
        here.filter(|o| ["p0", "p1", "p2", "p3"].contains(&o.point.as_str())).count()
    };
    assert!(project.photos.iter().all(|p| known(p) <= 2), "no photo is meant to show three control points");
    let oriented = orient(&project).expect("a valid project");
    assert!(all_oriented(&oriented), "{:?}", oriented.notes);
    for (p, t) in oriented.project.points.iter().zip(&truth.points) {
        let (Some(p), Some(t)) = (p.xyz, t.xyz) else { continue };
        let difference = (Vector3::from(p) - (Vector3::from(t) * 10.0 + shift)).norm();
        assert!(difference < 0.1, "{difference}");
    }
}

#[test]
fn what_is_given_stays_and_a_distance_scales() {
    let truth = network(80, 6, 30, 0.6, 0.1);
    let mut project = bare(&truth);
    let distance = |project: &Project| {
        let [a, b] = [0, 9].map(|k| Vector3::from(project.points[k].xyz.expect("coordinates")));
        (a - b).norm()
    };
    let length = 25.0 * distance(&truth);
    project.distances = vec![Distance { from: "p0".into(), to: "p9".into(), length, sigma: 0.01, check: false }];
    let scaled = orient(&project).expect("a valid project");
    assert!((distance(&scaled.project) / length - 1.0).abs() < 1e-3);
    assert!(scaled.notes.iter().any(|n| matches!(n, Note::System { scale: ScaleSource::Given, .. })));
    assert_eq!(scaled, orient(&project).expect("a valid project"), "the same bits");

    project.distances.clear();
    let unscaled = orient(&project).expect("a valid project");
    assert!(unscaled.notes.iter().any(|n| matches!(n, Note::System { scale: ScaleSource::Arbitrary, .. })));

    for k in [0, 1, 2] {
        project.photos[k] = truth.photos[k].clone();
    }
    project.cameras = truth.cameras.clone();
    project.cameras[0].free.clear();
    project.points[5].xyz = truth.points[5].xyz;
    let oriented = orient(&project).expect("a valid project");
    assert_eq!(oriented.project.photos[..3], truth.photos[..3]);
    assert_eq!(
        oriented.project.cameras,
        truth.cameras.iter().map(|c| Camera { free: vec![], ..c.clone() }).collect::<Vec<_>>()
    );
    assert_eq!(oriented.project.points[5].xyz, truth.points[5].xyz);
    assert!(all_oriented(&oriented));
    let off = points_fit(&oriented.project, &truth).residuals.iter().map(|v| v.norm()).fold(0.0, f64::max);
    assert!(off < 0.01, "{off}");
}

#[test]
fn what_cannot_be_oriented_is_said_by_name() {
    assert!(matches!(orient(&Project::default()), Err(Error::Empty { what: Lack::Photos })));
    let truth = network(90, 6, 30, 0.6, 0.1);
    let mut project = bare(&truth);
    let mut nothing = project.clone();
    nothing.observations.clear();
    assert!(matches!(orient(&nothing), Err(Error::Empty { what: Lack::Observations })));

    // A photo without points, a photo with two, a point seen once, a point not seen.
    project.photos.push(Photo { id: "blank".into(), camera: "k".into(), enabled: true, ..Photo::default() });
    let mut seen = 0;
    project.observations.retain(|o| {
        seen += usize::from(o.photo == "photo5");
        o.photo != "photo5" || seen <= 2
    });
    let mut rays = 0;
    project.observations.retain(|o| {
        rays += usize::from(o.point == "p3");
        o.point != "p4" && (o.point != "p3" || rays <= 1)
    });
    let once = project.observations.iter().find(|o| o.point == "p3").expect("one ray").photo.clone();
    let Oriented { project: found, notes } = orient(&project).expect("a valid project");
    let photo = |id: &str, reason: PhotoReason| notes.contains(&Note::PhotoNotOriented { photo: id.into(), reason });
    assert!(photo("blank", PhotoReason::NoPoints), "{notes:?}");
    assert!(photo("photo5", PhotoReason::TooFewPoints { determined: 2, needed: 4 }), "{notes:?}");
    let point = |id: &str, reason: PointReason| notes.contains(&Note::PointNotDetermined { point: id.into(), reason });
    assert!(point("p3", PointReason::SeenOnce { photo: once }), "{notes:?}");
    assert!(point("p4", PointReason::NotMeasured), "{notes:?}");
    assert_eq!(found.photos.iter().filter(|p| p.position.is_none()).count(), 2);

    // One photo alone, and two that share nothing.
    let mut lone = bare(&truth);
    lone.photos.truncate(1);
    lone.observations.retain(|o| o.photo == "photo0");
    let alone = orient(&lone).expect("a valid project");
    assert!(alone.project.photos[0].position.is_none() && !alone.notes.is_empty());
    let mut apart = bare(&truth);
    apart.photos.truncate(2);
    apart.observations.retain(|o| match o.photo.as_str() {
        "photo0" => o.point.len() == 2,
        "photo1" => o.point.len() == 3,
        _ => false,
    });
    assert!(orient(&apart).expect("a valid project").project.photos.iter().all(|p| p.position.is_none()));
}
