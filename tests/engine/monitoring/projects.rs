//! Epochs that are projects: photos of one object, adjusted with their full covariance.

use crate::support::networks::{Wanted, brown, exact, noisy};
use sightline::adjust::adjust;
use sightline::adjustment::AdjustOptions;
use sightline::matching::displaced;
use sightline::monitoring::{
    ComparisonMethod, Epoch, EpochNote, ListedPoint, Monitoring, Options, Outcome, Pair, PointRole, ReferenceFrom,
    VarianceUsed, compare_epochs,
};
use sightline::noise::Noise;
use sightline::project::{Camera, Datum, DatumKind, Distance, Observation, Parameter, Photo, Point, Project};

fn wanted(datum: DatumKind) -> Wanted {
    Wanted {
        photos: 6,
        points: 16,
        cameras: vec![brown(&[Parameter::C, Parameter::K1])],
        datum,
        control: if datum == DatumKind::Control { (8, 0.02) } else { (0, 0.0) },
        distances: (2, 0.01),
        sigma_px: 0.1,
        ..Wanted::default()
    }
}

/// Photos of the object at rest, and after some of its points moved.
fn projects(datum: DatumKind, seed: u64, moved: &[(usize, [f64; 3])]) -> [Project; 2] {
    let before = exact(&wanted(datum), seed);
    let mut moving = before.clone();
    for (k, d) in moved {
        let xyz = moving.points[*k].xyz.as_mut().unwrap();
        (0..3).for_each(|a| xyz[a] += d[a]);
    }
    // Seen from where the photos were taken; what is given stays as it was.
    for o in &mut moving.observations {
        let point = moving.points.iter().find(|p| p.id == o.point).unwrap().xyz.unwrap();
        let photo = moving.photos.iter().find(|p| p.id == o.photo).unwrap();
        let m = sightline::rotation::object_to_camera(photo.rotation.unwrap());
        let at = m * (nalgebra::Vector3::from(point) - nalgebra::Vector3::from(photo.position.unwrap()));
        [o.u, o.v] = sightline::camera::pixel_from_camera_point(&moving.cameras[0], at).unwrap();
    }
    for (point, given) in moving.points.iter_mut().zip(&before.points) {
        point.xyz = given.xyz;
    }
    [noisy(&before, &mut Noise::new(seed, 1)), noisy(&moving, &mut Noise::new(seed, 2))]
}

fn epochs(projects: &[Project; 2]) -> [Epoch; 2] {
    [0, 1].map(|k| Epoch { name: k.to_string(), project: Some(projects[k].clone()), ..Epoch::default() })
}

fn lengths(found: &Monitoring) -> Vec<f64> {
    found.pairs[0].points.iter().map(|p| p.length).collect()
}

#[test]
fn photos_before_and_after_show_what_moved() {
    // The ends of the scale bars, p0 to p3, stay.
    let moved = [(6, [0.0, 0.9, 0.0]), (12, [0.6, 0.0, -0.4])];
    let projects = projects(DatumKind::Free, 11, &moved);
    let reference: Vec<String> = (0..8).map(|k| format!("p{k}")).collect();
    let options = Options { reference: Some(reference), ..Options::default() };
    let found = compare_epochs(&epochs(&projects), &options).unwrap();
    let pair = &found.pairs[0];
    assert_eq!((pair.outcome, &pair.unstable[..]), (Outcome::StableGroup, &["p6".to_owned()][..]));
    let names: Vec<&str> = pair.points.iter().filter(|p| p.moved).map(|p| p.id.as_str()).collect();
    assert_eq!(names, ["p6", "p12"]);
    for (k, d) in moved {
        let point = &pair.points[k];
        (0..3).for_each(|a| assert!((point.difference[a] - d[a]).abs() < 4.0 * point.sigma[a], "{k} {a}"));
    }
    assert!(pair.scale.unwrap().test.passed && found.epochs.iter().all(|e| e.scaled && e.notes.is_empty()));

    // Adjustments that are there already, with another datum, change nothing.
    let mut again = epochs(&projects);
    for (k, epoch) in again.iter_mut().enumerate() {
        let project = epoch.project.as_mut().unwrap();
        project.datum.kind = if k == 0 { DatumKind::Minimal } else { DatumKind::Free };
        project.datum.points = (k == 1).then(|| (9..14).map(|k| format!("p{k}")).collect());
        let adjustment = adjust(project, &AdjustOptions::default(), &mut |_| true).unwrap();
        let covariance_of = adjustment.points.iter().map(|p| p.id.clone()).collect();
        let options =
            if k == 0 { AdjustOptions::default() } else { AdjustOptions { covariance_of, ..AdjustOptions::default() } };
        epoch.adjustment = Some(adjust(project, &options, &mut |_| true).unwrap());
    }
    let other = compare_epochs(&again, &options).unwrap();
    // The axes are those of another datum, lengths and tests are not.
    for (a, b) in found.pairs[0].points.iter().zip(&other.pairs[0].points) {
        assert!((a.length - b.length).abs() < 1e-6, "{}: {} {}", a.id, a.length, b.length);
        let (t, u) = (a.test.unwrap().statistic, b.test.unwrap().statistic);
        assert!((t - u).abs() < 1e-4 * (1.0 + t), "{}: {t} {u}", a.id);
    }
}

/// Given coordinates are the same in both epochs and hide that a control point moved: the epochs are compared as free networks.
#[test]
fn a_control_point_that_moved_is_found() {
    let projects = projects(DatumKind::Control, 23, &[(5, [0.7, 0.0, 0.5])]);
    let found = compare_epochs(&epochs(&projects), &Options::default()).unwrap();
    let pair = &found.pairs[0];
    assert_eq!(pair.reference_from, ReferenceFrom::Control);
    assert_eq!(pair.unstable, ["p5"]);
    let released = |notes: &[EpochNote]| matches!(notes, [EpochNote::ControlReleased { points }] if points.len() == 8);
    assert!(found.epochs.iter().all(|e| released(&e.notes)));
    assert!(lengths(&found).iter().enumerate().all(|(k, l)| if k == 5 { *l > 0.6 } else { *l < 0.4 }));
}

/// Photos of an object at rest: the covariances of the adjustment are those of the coordinates.
#[test]
fn photos_without_movement_are_congruent_as_often_as_the_test_says() {
    let pairs = crate::support::extent::cases(40, 200);
    let truth = exact(&wanted(DatumKind::Free), 5);
    let mut rejected = 0;
    for seed in 0..pairs as u64 {
        let both = [0, 1].map(|k| noisy(&truth, &mut Noise::new(1000 + seed, k)));
        let found = compare_epochs(&epochs(&both), &Options::default()).unwrap();
        rejected += usize::from(!found.pairs[0].global_test.unwrap().passed);
    }
    println!("{rejected} of {pairs} pairs of photos without movement rejected");
    assert!(crate::support::epochs::band(pairs, 0.05).contains(&rejected), "{rejected}");
}

/// Both epochs as one project: photos, cameras and object points of their own, stable points in common.
fn merged(projects: &[Project; 2], stable: &[String]) -> Project {
    let own = |k: usize, id: &str| if stable.iter().any(|s| s == id) { id.to_owned() } else { format!("{id}@{k}") };
    let mut all = Project { datum: Datum { kind: DatumKind::Free, points: None }, ..Project::default() };
    for (k, project) in projects.iter().enumerate() {
        let name = |id: &str| format!("{id}@{k}");
        all.cameras.extend(project.cameras.iter().cloned().map(|c| Camera { id: name(&c.id), ..c }));
        all.photos.extend(project.photos.iter().cloned().map(|p| Photo {
            id: name(&p.id),
            camera: name(&p.camera),
            ..p
        }));
        let known: Vec<String> = all.points.iter().map(|p| p.id.clone()).collect();
        let points = project.points.iter().map(|p| Point { id: own(k, &p.id), ..p.clone() });
        all.points.extend(points.filter(|p| !known.contains(&p.id)));
        let observed = project.observations.iter().cloned();
        all.observations.extend(observed.map(|o| Observation { photo: name(&o.photo), point: own(k, &o.point), ..o }));
        let bars = project.distances.iter().cloned();
        all.distances.extend(bars.map(|d| Distance { from: own(k, &d.from), to: own(k, &d.to), ..d }));
    }
    all
}

/// The displacements of a pair against one bundle adjustment of both epochs: lengths within so many millimetres, statistics by such a share.
fn is_one_adjustment(pair: &Pair, merged: &Project, length: f64, statistic: f64) {
    let first = adjust(merged, &AdjustOptions::default(), &mut |_| true).unwrap();
    let covariance_of: Vec<String> = first.points.iter().map(|p| p.id.clone()).collect();
    let options = AdjustOptions { covariance_of, ..AdjustOptions::default() };
    let together = adjust(merged, &options, &mut |_| true).unwrap();
    let covariance = together.covariance.unwrap();
    let at = |id: &str| covariance.points.iter().position(|p| p == id).unwrap();
    let mut compared = 0;
    for point in pair.points.iter().filter(|p| p.role == PointRole::Object) {
        let [a, b] = [0, 1].map(|k| at(&format!("{}@{k}", point.id)));
        let [x, y] = [a, b].map(|k| {
            nalgebra::Vector3::from(together.points.iter().find(|p| p.id == covariance.points[k]).unwrap().xyz)
        });
        // The system of the merged network is another one: lengths and forms are the same.
        let d = y - x;
        let value = |i: usize, j: usize| covariance.matrix[i][j];
        let c = nalgebra::Matrix3::from_fn(|i, j| {
            value(3 * a + i, 3 * a + j) + value(3 * b + i, 3 * b + j)
                - value(3 * a + i, 3 * b + j)
                - value(3 * b + i, 3 * a + j)
        });
        let t = d.dot(&(c.try_inverse().unwrap() * d)) / 3.0;
        let test = point.test.unwrap();
        println!("{}: {:.9} {:.9} mm, T {:.9} {:.9}", point.id, point.length, d.norm(), test.statistic, t);
        assert!((point.length - d.norm()).abs() < length, "{}", point.id);
        assert!((t / test.statistic - 1.0).abs() < statistic, "{}: {t} {}", point.id, test.statistic);
        assert_eq!(test.f2, Some(together.redundancy as f64));
        compared += 1;
    }
    assert_eq!(compared, 8);
    assert!(pair.points.iter().filter(|p| p.role == PointRole::Reference).all(|p| p.length == 0.0 && p.test.is_none()));
}

/// Both epochs with one camera.
fn with_one_camera(mut merged: Project) -> Project {
    merged.cameras.truncate(1);
    let id = merged.cameras[0].id.clone();
    merged.photos.iter_mut().for_each(|photo| photo.camera.clone_from(&id));
    merged
}

#[test]
fn the_joint_method_is_the_adjustment_of_both_epochs_together() {
    let both = projects(DatumKind::Free, 31, &[(12, [0.3, 0.2, -0.1])]);
    let reference: Vec<String> = (0..8).map(|k| format!("p{k}")).collect();
    let options = Options { reference: Some(reference), method: ComparisonMethod::Joint, ..Options::default() };
    let found = compare_epochs(&epochs(&both), &options).unwrap();
    let pair = &found.pairs[0];
    assert_eq!((pair.variance, pair.outcome), (VarianceUsed::Pooled, Outcome::Congruent));
    // What differs is of second order: errors of 0.05 mm on an object of 1 m.
    is_one_adjustment(pair, &merged(&both, &pair.stable), 2e-5, 5e-4);
    let shared_cameras = vec![both[0].cameras[0].id.clone()];
    let found = compare_epochs(&epochs(&both), &Options { shared_cameras, ..options }).unwrap();
    let stable = &found.joint.as_ref().unwrap().points;
    is_one_adjustment(&found.pairs[0], &with_one_camera(merged(&both, stable)), 1e-6, 1e-6);
}

/// Largest difference of a length of displacement between the joint method and one bundle adjustment, with noise of so many times that of
/// [`wanted`].
fn joint_gap(noise: f64) -> f64 {
    let own = Wanted { sigma_px: 0.1 * noise, distances: (2, 0.01 * noise), ..wanted(DatumKind::Free) };
    let truth = exact(&own, 31);
    let both = [1, 2].map(|k| noisy(&truth, &mut Noise::new(31, k)));
    let reference: Vec<String> = (0..8).map(|k| format!("p{k}")).collect();
    let options = Options { reference: Some(reference), method: ComparisonMethod::Joint, ..Options::default() };
    let found = compare_epochs(&epochs(&both), &options).unwrap();
    let pair = &found.pairs[0];
    let together = adjust(&merged(&both, &pair.stable), &AdjustOptions::default(), &mut |_| true).unwrap();
    let place = |id: String| nalgebra::Vector3::from(together.points.iter().find(|p| p.id == id).unwrap().xyz);
    let gaps = pair.points.iter().filter(|p| p.role == PointRole::Object).map(|p| {
        let d = place(format!("{}@1", p.id)) - place(format!("{}@0", p.id));
        (p.length - d.norm()).abs()
    });
    gaps.fold(0.0, f64::max)
}

/// The difference goes with the square of the noise: it is of the linearisation, and neither of the convergence nor of the datum.
#[test]
fn what_the_joint_method_leaves_out_is_of_second_order() {
    let (whole, quarter) = (joint_gap(1.0), joint_gap(0.25));
    println!(
        "joint method against one bundle adjustment: {whole:.2e} mm, with a quarter of the noise {quarter:.2e} mm"
    );
    assert!((10.0..26.0).contains(&(whole / quarter)), "{whole:e} {quarter:e}");
}

/// Displacements in the photos of epoch 0 end where the photos of the next epoch, taken from the same places, show the points, in
/// whatever system the epochs are compared.
#[test]
fn displacements_in_photos_end_where_the_later_photos_show_the_points() {
    let moved = [(9, [0.0, 25.0, 5.0]), (12, [20.0, 0.0, -15.0])];
    let projects = projects(DatumKind::Free, 23, &moved);
    let adjustment = adjust(&projects[0], &AdjustOptions::default(), &mut |_| true).unwrap();
    let reference: Vec<String> = (0..8).map(|k| format!("p{k}")).collect();
    let options = Options { reference: Some(reference), ..Options::default() };
    let turn = nalgebra::Rotation3::from_euler_angles(0.4, -0.7, 2.1);
    let turned = adjustment.points.iter().map(|p| {
        let xyz = turn * nalgebra::Vector3::from(p.xyz) + nalgebra::Vector3::new(5e3, -2e3, 300.0);
        ListedPoint { id: p.id.clone(), xyz: xyz.into(), sigma: p.sigma }
    });
    let turned = Epoch { name: "turned".into(), points: Some(turned.collect()), ..Epoch::default() };
    let [first, second] = epochs(&projects);
    for first in [first, turned] {
        let found = compare_epochs(&[first, second.clone()], &options).unwrap();
        let shown = displaced(&projects[0], &adjustment, &found.pairs[0], 1.0).unwrap();
        assert_eq!(shown.len(), projects[0].photos.len());
        let place = |project: &Project, photo: &str, point: &str| {
            let o = project.observations.iter().find(|o| o.photo == photo && o.point == point).expect("measured");
            [o.u, o.v]
        };
        let (mut count, mut longest) = (0, 0.0_f64);
        for photo in &shown {
            for vector in &photo.vectors {
                let ends = [0, 1].map(|k| place(&projects[k], &photo.photo, &vector.point));
                let off = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
                assert!(off(vector.from, ends[0]) < 1.0, "{} {vector:?} {ends:?}", photo.photo);
                assert!(off(vector.to, ends[1]) < 1.5, "{} {vector:?} {ends:?}", photo.photo);
                assert_eq!(vector.moved, ["p9", "p12"].contains(&vector.point.as_str()), "{vector:?}");
                longest = longest.max(off(vector.from, vector.to));
                count += 1;
            }
        }
        let measured = projects[0].observations.iter().filter(|o| o.enabled).count();
        assert!(count == measured && longest > 10.0, "{count} of {measured}, longest {longest} px");
        // So many times as long, some end behind the camera: each is drawn or named.
        let far = displaced(&projects[0], &adjustment, &found.pairs[0], 1e5).unwrap();
        let named: usize = far.iter().map(|photo| photo.not_drawn.len()).sum();
        let drawn: usize = far.iter().map(|photo| photo.vectors.len()).sum();
        assert!(named > 0 && named + drawn == measured, "{named} + {drawn} of {measured}");
        assert!(shown.iter().all(|photo| photo.not_drawn.is_empty()));
    }
    let mut stranger = projects[0].clone();
    stranger.points.iter_mut().for_each(|point| point.id = format!("other {}", point.id));
    stranger.observations.iter_mut().for_each(|o| o.point = format!("other {}", o.point));
    for distance in &mut stranger.distances {
        [distance.from, distance.to] = [&distance.from, &distance.to].map(|end| format!("other {end}"));
    }
    let apart = adjust(&stranger, &AdjustOptions::default(), &mut |_| true).unwrap();
    let pair = &compare_epochs(&epochs(&projects), &options).unwrap().pairs[0];
    let refused = displaced(&stranger, &apart, pair, 1.0).unwrap_err().to_string();
    assert!(refused.contains("common to the project and the comparison: 0"), "{refused}");
    assert!(
        displaced(&projects[0], &adjustment, &compare_epochs(&epochs(&projects), &options).unwrap().pairs[0], 0.0)
            .is_err()
    );
}
