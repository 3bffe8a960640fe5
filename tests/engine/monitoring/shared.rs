//! The joint adjustment of all epochs, with and without shared cameras.

use crate::support::epochs::band;
use crate::support::extent::cases;
use crate::support::networks::{Wanted, brown, exact, noisy};
use sightline::error::{Error, Reason};
use sightline::monitoring::{ComparisonMethod, Epoch, Monitoring, Options, PairNote, PointRole, compare_epochs};
use sightline::noise::Noise;
use sightline::project::{DatumKind, Parameter, Project};

/// Few photos of a camera whose principal distance and distortion are estimated, so that another epoch improves them.
fn wanted() -> Wanted {
    Wanted {
        photos: 6,
        points: 16,
        cameras: vec![brown(&[Parameter::C, Parameter::X0, Parameter::Y0, Parameter::K1])],
        datum: DatumKind::Free,
        distances: (2, 0.01),
        sigma_px: 0.1,
        ..Wanted::default()
    }
}

/// Epochs of an object at rest; `changes` are the changes of the principal distance in each epoch.
fn rest(seed: u64, changes: &[f64]) -> Vec<Epoch> {
    let truth = exact(&wanted(), 5);
    let epoch = |(k, change): (usize, &f64)| {
        let mut own = truth.clone();
        if *change != 0.0 {
            let c = own.cameras[0].interior.get(Parameter::C).unwrap();
            own.cameras[0].interior.set(Parameter::C, c + change);
            project_again(&mut own);
        }
        let project = noisy(&own, &mut Noise::new(seed, 1 + k as u64));
        let date = Some(format!("2026-{:02}-01", k + 1));
        Epoch { name: k.to_string(), date, project: Some(project), ..Epoch::default() }
    };
    changes.iter().enumerate().map(epoch).collect()
}

fn project_again(project: &mut Project) {
    for o in &mut project.observations {
        let point = project.points.iter().find(|p| p.id == o.point).unwrap().xyz.unwrap();
        let photo = project.photos.iter().find(|p| p.id == o.photo).unwrap();
        let m = sightline::rotation::object_to_camera(photo.rotation.unwrap());
        let at = m * (nalgebra::Vector3::from(point) - nalgebra::Vector3::from(photo.position.unwrap()));
        [o.u, o.v] = sightline::camera::pixel_from_camera_point(&project.cameras[0], at).unwrap();
    }
}

fn options(shared: bool) -> Options {
    let epochs = rest(1, &[0.0]);
    let camera = epochs[0].project.as_ref().unwrap().cameras[0].id.clone();
    Options {
        reference: Some((0..8).map(|k| format!("p{k}")).collect()),
        method: ComparisonMethod::Joint,
        shared_cameras: if shared { vec![camera] } else { Vec::new() },
        ..Options::default()
    }
}

fn objects(found: &Monitoring, pair: usize) -> Vec<&sightline::monitoring::Displacement> {
    found.pairs[pair].points.iter().filter(|p| p.role == PointRole::Object).collect()
}

/// Without shared cameras the joint adjustment of three epochs agrees with the comparison of a pair, except that the third epoch improves
/// the stable points and the variance factor.
#[test]
fn without_shared_cameras_it_agrees_with_separate_adjustments() {
    let epochs = rest(41, &[0.0, 0.0, 0.0]);
    let all = compare_epochs(&epochs, &options(false)).unwrap();
    let told = all.joint.as_ref().expect("one adjustment of all");
    assert!(told.cameras.is_empty() && told.points.len() >= 4, "{told:?}");
    let pair = compare_epochs(&epochs[..2], &options(false)).unwrap();
    assert!(pair.joint.is_none());
    assert_eq!(all.pairs.len(), 3);
    for (a, b) in objects(&all, 0).iter().zip(objects(&pair, 0)) {
        assert_eq!(a.id, b.id);
        for axis in 0..3 {
            // The third epoch changes a difference by less than its standard error.
            assert!((a.difference[axis] - b.difference[axis]).abs() < b.sigma[axis], "{} {axis}", a.id);
            assert!(
                (0.7..1.1).contains(&(a.sigma[axis] / b.sigma[axis])),
                "{} {} {}",
                a.id,
                a.sigma[axis],
                b.sigma[axis]
            );
        }
    }
    // Displacements from one adjustment are consistent: 0 to 1 plus 1 to 2 is 0 to 2.
    for point in objects(&all, 0) {
        let of = |pair: usize| all.pairs[pair].points.iter().find(|p| p.id == point.id).unwrap().difference;
        let gap = (0..3).map(|a| (of(0)[a] + of(2)[a] - of(1)[a]).abs()).fold(0.0, f64::max);
        assert!(gap < 1e-9, "{}: {gap}", point.id);
        let series = all.series.iter().find(|s| s.id == point.id).unwrap();
        assert!(series.velocity.is_some() && series.values[1].difference == of(1), "{}", point.id);
    }
}

#[test]
fn a_shared_camera_improves_the_precision() {
    let epochs = rest(43, &[0.0, 0.0]);
    let own = compare_epochs(&epochs, &options(false)).unwrap();
    let shared = compare_epochs(&epochs, &options(true)).unwrap();
    let told = shared.joint.as_ref().unwrap();
    let test = told.cameras[0].test.unwrap();
    // The false rejection rate is tested over many draws; p of this draw is 0.014.
    assert!(test.p > 1e-3 && test.f1 == 4.0, "{test:?}");
    // Fewer unknowns: four camera parameters and the coordinates of the stable points; and six datum constraints fewer.
    let gained = 3.0 * told.points.len() as f64 - 6.0 + 4.0;
    assert_eq!(told.redundancy as f64, own.pairs[0].redundancy.unwrap() + gained);
    let mean = |found: &Monitoring| {
        let all = objects(found, 0);
        // Cofactors are compared, since the estimated variance factors differ by chance.
        let s = if found.joint.is_some() { told.sigma0.unwrap() } else { found.pairs[0].sigma0.unwrap() };
        all.iter().map(|p| p.sigma.iter().map(|x| x * x).sum::<f64>()).sum::<f64>() / all.len() as f64 / (s * s)
    };
    let ratio = (mean(&shared) / mean(&own)).sqrt();
    println!("standard errors with a shared camera over those with cameras per epoch: {ratio:.3}");
    assert!(ratio < 1.0, "{ratio}");
}

/// 95 % ellipsoids of displacements of an object at rest contain zero in 95 % of independent draws; one point per draw.
#[test]
fn ellipsoids_have_their_coverage_with_a_shared_camera() {
    let (draws, mut outside, mut camera, mut joint) = (cases(60, 300), 0, 0, 0);
    let options = Options { correction: sightline::monitoring::Correction::None, ..options(true) };
    for seed in 0..draws as u64 {
        let found = compare_epochs(&rest(5000 + seed, &[0.0, 0.0]), &options).unwrap();
        let Some(told) = &found.joint else { continue };
        let point = found.pairs[0].points.iter().find(|p| p.id == "p12").unwrap();
        joint += 1;
        outside += usize::from(!point.test.unwrap().passed);
        camera += usize::from(!told.cameras[0].test.unwrap().passed);
    }
    println!("of {joint} draws: zero outside {outside} ellipsoids; the shared camera rejected {camera} times");
    assert_eq!(joint, draws);
    assert!(band(joint, 0.05).contains(&outside) && band(joint, 0.05).contains(&camera), "{outside} {camera}");
}

#[test]
fn a_refocused_camera_is_reported() {
    let found = compare_epochs(&rest(47, &[0.0, 0.05]), &options(true)).unwrap();
    let told = found.joint.as_ref().unwrap();
    let test = told.cameras[0].test.unwrap();
    assert!(!test.passed && test.p < 1e-6, "{test:?}");
    assert!(
        found.pairs[0]
            .notes
            .iter()
            .any(|n| matches!(n, PairNote::CameraDiffers { camera } if *camera == told.cameras[0].id))
    );
}

#[test]
fn cameras_that_cannot_be_shared_are_refused() {
    let epochs = rest(49, &[0.0, 0.0]);
    let refused = |epochs: &[Epoch], options: &Options| match compare_epochs(epochs, options) {
        Err(Error::Invalid { reason, .. }) => reason,
        other => panic!("{other:?}"),
    };
    let by_coordinates = Options { method: ComparisonMethod::Coordinates, ..options(true) };
    assert_eq!(refused(&epochs, &by_coordinates), Reason::EpochShareMethod);
    let unknown = Options { shared_cameras: vec!["other".into()], ..options(true) };
    assert!(matches!(refused(&epochs, &unknown), Reason::EpochCameraMissing { .. }));
    let mut e = epochs.clone();
    e[1].project.as_mut().unwrap().cameras[0].free.pop();
    assert!(matches!(refused(&e, &options(true)), Reason::EpochCameraUnlike { .. }));
    let mut e = epochs.clone();
    e[1].project.as_mut().unwrap().cameras[0].width += 2;
    assert!(matches!(refused(&e, &options(true)), Reason::EpochCameraUnlike { .. }));
}

/// Too many points are not adjusted jointly: that is reported, and the epochs are compared in pairs.
#[test]
fn too_many_points_are_compared_in_pairs() {
    let many = Wanted { points: 360, photos: 4, ..wanted() };
    let truth = exact(&many, 5);
    let epoch = |k: u64| {
        let project = noisy(&truth, &mut Noise::new(51, 1 + k));
        Epoch { name: k.to_string(), project: Some(project), ..Epoch::default() }
    };
    let epochs: Vec<Epoch> = (0..3).map(epoch).collect();
    let found = compare_epochs(&epochs, &options(false)).unwrap();
    assert!(found.joint.is_none());
    let told = |pair: &sightline::monitoring::Pair| {
        pair.notes.iter().any(|n| matches!(n, PairNote::TooManyTogether { points, limit: 1000 } if *points > 1000))
    };
    assert!(found.pairs.iter().all(told));
    let refused = compare_epochs(&epochs, &options(true)).unwrap_err();
    assert!(refused.to_string().contains("at most 1000"), "{refused}");
}
