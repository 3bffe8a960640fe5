//! Measuring on the result: against Monte Carlo draws from the full covariance, against fits of another kind, and what is refused.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use sightline::adjust::{adjust, measured};
use sightline::adjustment::{AdjustOptions, AdjustedPoint, Adjustment, MeasuredFeature, StatisticsChoice};
use sightline::features::measure;
use sightline::noise::Noise;
use sightline::project::{CoordinateSystem, DatumKind, End, Feature, FeatureKind, GivenPoint, Project, SystemKind};

use crate::support::extent;
use crate::support::networks::{Wanted, exact, noisy};

/// Draws from a covariance, in the daily extent and in the full one.
const DRAWS: [usize; 2] = [2_000, 12_000];
/// Whole adjustments likewise: the scatter of 4,000 is known to 1.1 %.
const RUNS: [usize; 2] = [800, 4_000];

fn feature(id: &str, kind: FeatureKind) -> Feature {
    Feature { id: id.into(), kind }
}

fn named(range: std::ops::Range<usize>) -> Vec<String> {
    range.map(|k| format!("p{k}")).collect()
}

/// A truly turned object in the middle of the network: a plane, a ring, a pipe, a ball, an edge.
fn truth(datum: DatumKind, distances: usize) -> Project {
    let wanted = Wanted { points: 64, datum, distances: (distances, 0.05), control: (0, 0.0), ..Wanted::default() };
    let mut project = exact(&wanted, 5);
    let turn = nalgebra::Rotation3::from_euler_angles(0.3, -0.5, 1.1);
    let place = |k: usize| {
        let t = k as f64;
        let around = |r: f64, step: f64, z: f64| Vector3::new(r * (step * t).cos(), r * (step * t).sin(), z);
        match k {
            0..16 => Vector3::new(-200.0 + 90.0 * (k % 4) as f64, -150.0 + 80.0 * (k / 4) as f64, -60.0),
            16..28 => around(110.0, 0.55, 40.0) + Vector3::new(30.0, -20.0, 0.0),
            28..46 => around(80.0, 0.7, -50.0 + 9.0 * (k - 28) as f64),
            46..58 => {
                Vector3::new((2.4 * t).cos(), (2.4 * t).sin(), 0.0).scale((1.0 - (t / 6.0 - 8.6).powi(2)).sqrt()) * 60.0
                    + Vector3::new(150.0, 100.0, 60.0 * (t / 6.0 - 8.6))
            }
            // Well away from across the pipe: an angle that is folded at 90° has no normal distribution there.
            _ => Vector3::new(-180.0 + 60.0 * (k - 58) as f64, 200.0, 90.0 - 25.0 * (k - 58) as f64),
        }
    };
    let moved: Vec<Vector3<f64>> = (0..64).map(|k| turn * place(k)).collect();
    let cameras = project.cameras.clone();
    for (point, xyz) in project.points.iter_mut().zip(&moved) {
        point.xyz = Some((*xyz).into());
    }
    for o in &mut project.observations {
        let photo = project.photos.iter().find(|p| p.id == o.photo).expect("there");
        let m = sightline::rotation::object_to_camera(photo.rotation.expect("oriented"));
        let k: usize = o.point[1..].parse().expect("a number");
        let x = m * (moved[k] - Vector3::from(photo.position.expect("oriented")));
        let camera = cameras.iter().find(|c| c.id == photo.camera).expect("there");
        [o.u, o.v] = sightline::camera::pixel_from_camera_point(camera, x).expect("in front");
    }
    for d in &mut project.distances {
        let at = |id: &str| moved[id[1..].parse::<usize>().expect("a number")];
        d.length = (at(&d.from) - at(&d.to)).norm();
    }
    let end = |id: &str| End::Feature(id.into());
    let point = |k: usize| End::Point(format!("p{k}"));
    project.features = vec![
        feature("plane", FeatureKind::Plane { points: named(0..16) }),
        feature("ring", FeatureKind::Circle { points: named(16..28) }),
        feature("pipe", FeatureKind::Cylinder { points: named(28..46) }),
        feature("ball", FeatureKind::Sphere { points: named(46..58) }),
        feature("edge", FeatureKind::Line { points: named(58..64) }),
        feature("length", FeatureKind::Distance { from: point(3), to: point(59) }),
        feature("height", FeatureKind::Distance { from: end("plane"), to: point(20) }),
        feature("centres", FeatureKind::Distance { from: end("ring"), to: end("ball") }),
        feature("skew", FeatureKind::Distance { from: end("pipe"), to: end("edge") }),
        feature("off axis", FeatureKind::Distance { from: end("pipe"), to: end("ball") }),
        feature("corner", FeatureKind::Angle { from: point(1), at: Some(point(5)), to: point(60) }),
        feature("tilt", FeatureKind::Angle { from: end("edge"), at: None, to: end("pipe") }),
        feature(
            "flatness",
            FeatureKind::Deviations { points: named(20..24), feature: Some("plane".into()), given: vec![] },
        ),
        feature(
            "bulge",
            FeatureKind::Deviations { points: named(40..44), feature: Some("pipe".into()), given: vec![] },
        ),
        feature("round", FeatureKind::Deviations { points: named(0..2), feature: Some("ring".into()), given: vec![] }),
    ];
    let given = |k: usize| GivenPoint {
        id: format!("p{k}"),
        xyz: (moved[k] + Vector3::new(10.0, 0.1 * (k % 3) as f64, 0.0)).into(),
        sigma: Some([0.1, 0.2, 0.1 + 0.1 * (k % 2) as f64]),
    };
    let system = |id: &str, kind| CoordinateSystem { id: id.into(), kind };
    project.systems = vec![
        system("auto", SystemKind::Automatic { points: named(0..16) }),
        system("321", SystemKind::PlaneLinePoint { plane: named(0..16), line: named(58..64), point: "p17".into() }),
        system("fit", SystemKind::BestFit { given: (20..40).map(given).collect(), scale: true }),
        system("rigid", SystemKind::BestFit { given: (20..40).map(given).collect(), scale: false }),
    ];
    project
}

fn network(datum: DatumKind, distances: usize) -> Project {
    noisy(&truth(datum, distances), &mut Noise::new(7, 0))
}

fn adjusted(project: &Project) -> Adjustment {
    let options = AdjustOptions { covariance_of: named(0..64), ..AdjustOptions::default() };
    adjust(project, &options, &mut |_| true).expect("solvable")
}

/// Every figure of a feature that has a standard error, by name.
fn figures(f: &MeasuredFeature) -> Vec<(String, f64, Option<f64>)> {
    let mut all = Vec::new();
    all.extend(f.value.map(|v| (format!("{} value", f.id), v, f.sigma)));
    for axis in 0..3 {
        all.extend(
            f.position.map(|p| (format!("{} position {axis}", f.id), p[axis], f.sigma_position.map(|s| s[axis]))),
        );
    }
    let deviations = f.residuals.iter().filter(|_| f.kind == "deviations");
    all.extend(deviations.map(|r| (format!("{} at {}", f.id, r.point), r.value, r.sigma)));
    all
}

/// How far a standard error that is estimated from `count` draws may be off its value: `limit` for the largest number of draws, four of its
/// own standard errors, 4/√(2n), for fewer.
fn chance(limit: f64, count: usize, [_, most]: [usize; 2]) -> f64 {
    if count == most { limit } else { 4.0 / (2.0 * count as f64).sqrt() }
}

fn assert_draws_agree(project: &Project) {
    let draws = extent::cases(DRAWS[0], DRAWS[1]);
    let limit = chance(0.03, draws, DRAWS);
    let adjustment = adjusted(project);
    let covariance = adjustment.covariance.as_ref().expect("asked for");
    let n = covariance.matrix.len();
    let eigen = DMatrix::from_fn(n, n, |i, j| covariance.matrix[i][j]).symmetric_eigen();
    let root = &eigen.eigenvectors * DMatrix::from_diagonal(&eigen.eigenvalues.map(|v| v.max(0.0).sqrt()));
    let mut noise = Noise::new(11, 0);
    let stated: Vec<_> = adjustment.features.iter().flat_map(figures).collect();
    let points: Vec<_> = adjustment
        .systems
        .iter()
        .flat_map(|s| {
            s.points
                .iter()
                .flat_map(|p| (0..3).map(|k| (format!("{} {} {k}", s.id, p.id), p.xyz[k], p.sigma.expect("stated")[k])))
        })
        .collect();
    let (mut squares, mut point_squares) = (vec![0.0; stated.len()], vec![0.0; points.len()]);
    let mut tilts: Vec<Matrix3<f64>> = vec![Matrix3::zeros(); adjustment.features.len()];
    for draw in 0..draws {
        let shift = &root * DVector::from_fn(n, |_, _| noise.normal());
        let moved = |(k, p): (usize, &AdjustedPoint)| AdjustedPoint {
            xyz: std::array::from_fn(|a| p.xyz[a] + shift[3 * k + a]),
            ..p.clone()
        };
        let moved: Vec<_> = adjustment.points.iter().enumerate().map(moved).collect();
        // Systems are much slower than features in a draw: every fourth is enough for them.
        let systems = if draw % 4 == 0 { project.systems.clone() } else { Vec::new() };
        let asked = Project { features: project.features.clone(), systems, ..Project::default() };
        let found = measure(&asked, &moved, &adjustment.photos, &mut |_| Ok(None)).expect("measured");
        for (square, ((_, now, _), (_, value, _))) in
            squares.iter_mut().zip(found.features.iter().flat_map(figures).zip(&stated))
        {
            *square += (now - value).powi(2);
        }
        for (sum, (now, then)) in tilts.iter_mut().zip(found.features.iter().zip(&adjustment.features)) {
            if let (Some(a), Some(b)) = (now.direction, then.direction) {
                let d = Vector3::from(a) - Vector3::from(b);
                *sum += d * d.transpose();
            }
        }
        let all = found.systems.iter().flat_map(|s| s.points.iter().flat_map(|p| p.xyz));
        for (square, (now, (_, value, _))) in point_squares.iter_mut().zip(all.zip(&points)) {
            *square += (now - value).powi(2);
        }
    }
    let mut worst: f64 = 0.0;
    for ((name, _, sigma), square) in stated.iter().zip(&squares) {
        let drawn = (square / draws as f64).sqrt();
        let ratio = drawn / sigma.unwrap_or_else(|| panic!("{name} has no sigma"));
        worst = worst.max((ratio - 1.0).abs());
        assert!((ratio - 1.0).abs() < limit, "{name}: {ratio}, drawn {drawn}");
    }
    for (f, sum) in adjustment.features.iter().zip(&tilts).filter(|(f, _)| f.direction.is_some()) {
        let ratio = (sum / draws as f64).symmetric_eigenvalues().max().sqrt() / f.sigma_direction.expect("stated");
        assert!((ratio - 1.0).abs() < limit, "direction of {}: {ratio}", f.id);
    }
    let runs = draws.div_ceil(4) as f64;
    for ((name, _, sigma), square) in points.iter().zip(&point_squares) {
        let drawn = (square / runs).sqrt();
        if *sigma == 0.0 {
            assert!(drawn < 1e-6, "{name} is held, and moves by {drawn}");
        } else {
            // There are hundreds of figures, of a quarter of the draws.
            assert!((drawn / sigma - 1.0).abs() < 7.0 / (2.0 * runs).sqrt(), "{name}: {}", drawn / sigma);
        }
    }
    if points.is_empty() {
        return;
    }
    let mean: f64 = points
        .iter()
        .zip(&point_squares)
        .filter(|((_, _, s), _)| *s > 0.0)
        .map(|((_, _, s), q)| q / runs / (s * s))
        .sum::<f64>()
        / points.iter().filter(|(_, _, s)| *s > 0.0).count() as f64;
    assert!(
        (mean.sqrt() - 1.0).abs() < if draws == DRAWS[1] { 0.02 } else { 0.05 },
        "all points of all systems: {}",
        mean.sqrt()
    );
}

#[test]
fn standard_errors_are_those_of_draws_from_the_full_covariance_of_a_free_network() {
    assert_draws_agree(&network(DatumKind::Free, 2));
}

#[test]
fn standard_errors_are_those_of_draws_under_minimal_constraints() {
    let mut project = network(DatumKind::Minimal, 1);
    project.systems.clear();
    assert_draws_agree(&project);
}

/// The whole way again and again: noise of the observations, adjustment, measurement. Nothing of the covariance is used.
#[test]
fn standard_errors_are_the_scatter_of_adjusted_noise() {
    let mut truth = truth(DatumKind::Free, 2);
    truth.systems.clear();
    let one = adjusted(&noisy(&truth, &mut Noise::new(7, 0)));
    // Its standard errors are scaled by its own sigma0: that of the noise is 1.
    let sigma0 = one.sigma0.expect("redundant");
    let stated: Vec<_> = one.features.iter().flat_map(figures).collect();
    let options = AdjustOptions { statistics: StatisticsChoice::None, ..AdjustOptions::default() };
    let features = Project { features: std::mem::take(&mut truth.features), ..Project::default() };
    let mut noise = Noise::new(23, 0);
    let (mut sums, mut squares) = (vec![0.0; stated.len()], vec![0.0; stated.len()]);
    let count = extent::cases(RUNS[0], RUNS[1]);
    for _ in 0..count {
        let found = adjust(&noisy(&truth, &mut noise), &options, &mut |_| true).expect("solvable");
        let measured = measure(&features, &found.points, &found.photos, &mut |_| Ok(None)).expect("measured");
        for (k, (_, value, _)) in measured.features.iter().flat_map(figures).enumerate() {
            let off = value - stated[k].1;
            sums[k] += off;
            squares[k] += off * off;
        }
    }
    let n = count as f64;
    let limit = chance(0.03, count, RUNS);
    for (k, (name, _, sigma)) in stated.iter().enumerate() {
        let scatter = ((squares[k] - sums[k] * sums[k] / n) / (n - 1.0)).sqrt();
        let ratio = scatter * sigma0 / sigma.unwrap_or_else(|| panic!("{name} has no sigma"));
        println!("{name}: {ratio:.4}");
        assert!((ratio - 1.0).abs() < limit, "{name}: {ratio}, scatter {scatter}");
    }
}

/// The least of a function of a few variables, by a simplex that creeps towards it (Nelder and Mead 1965): no derivative, nothing
/// in common with what is tested.
pub fn least(start: &[f64], step: f64, f: impl Fn(&[f64]) -> f64) -> Vec<f64> {
    let n = start.len();
    let mut best = start.to_vec();
    let mut size = step;
    for _ in 0..12 {
        let mut simplex: Vec<(f64, Vec<f64>)> = (0..=n)
            .map(|k| {
                let mut x = best.clone();
                if k < n {
                    x[k] += size;
                }
                (f(&x), x)
            })
            .collect();
        for _ in 0..400 * n {
            simplex.sort_by(|a, b| a.0.total_cmp(&b.0));
            let centre: Vec<f64> =
                (0..n).map(|j| simplex[..n].iter().map(|s| s.1[j]).sum::<f64>() / n as f64).collect();
            let along =
                |t: f64| -> Vec<f64> { (0..n).map(|j| centre[j] + t * (simplex[n].1[j] - centre[j])).collect() };
            let tried = |x: Vec<f64>| (f(&x), x);
            let reflected = tried(along(-1.0));
            let next = if reflected.0 < simplex[0].0 {
                let further = tried(along(-2.0));
                Some(if further.0 < reflected.0 { further } else { reflected })
            } else if reflected.0 < simplex[n - 1].0 {
                Some(reflected)
            } else {
                let inside = tried(along(0.5));
                (inside.0 < simplex[n].0).then_some(inside)
            };
            match next {
                Some(next) => simplex[n] = next,
                None => {
                    let first = simplex[0].1.clone();
                    for s in &mut simplex[1..] {
                        s.1.iter_mut().zip(&first).for_each(|(x, b)| *x = (*x + b) / 2.0);
                        s.0 = f(&s.1);
                    }
                }
            }
        }
        simplex.sort_by(|a, b| a.0.total_cmp(&b.0));
        best = simplex[0].1.clone();
        size /= 8.0;
    }
    best
}

#[test]
fn forms_are_those_of_another_fit() {
    let project = network(DatumKind::Free, 1);
    let adjustment = adjusted(&project);
    let of = |id: &str| adjustment.features.iter().find(|f| f.id == id).expect("measured");
    let places = |range: std::ops::Range<usize>| -> Vec<Vector3<f64>> {
        adjustment.points[range].iter().map(|p| p.xyz.into()).collect()
    };
    // Plane and line by singular values.
    for (id, range, which) in [("plane", 0..16, 2), ("edge", 58..64, 0)] {
        let x = places(range);
        let mean = x.iter().sum::<Vector3<f64>>() / x.len() as f64;
        let matrix = DMatrix::from_fn(x.len(), 3, |i, j| x[i][j] - mean[j]);
        let v = matrix.svd(false, true).v_t.expect("asked for").row(which).transpose();
        let direction = Vector3::from(of(id).direction.expect("a direction"));
        assert!(1.0 - direction.dot(&Vector3::new(v[0], v[1], v[2])).abs() < 1e-14, "{id}");
        assert!((Vector3::from(of(id).position.expect("a position")) - mean).norm() < 1e-9, "{id}");
    }
    // Round forms by a search without derivatives, from rough values.
    let unit = |a: f64, b: f64| Vector3::new(a.sin() * b.cos(), a.sin() * b.sin(), a.cos());
    let angles = |d: Vector3<f64>| [d.z.acos(), d.y.atan2(d.x)];
    let ball = places(46..58);
    let centre = Vector3::from(of("ball").position.expect("a centre"));
    let found = least(&[centre.x + 3.0, centre.y - 2.0, centre.z + 1.0, 55.0], 4.0, |p| {
        ball.iter().map(|x| ((x - Vector3::new(p[0], p[1], p[2])).norm() - p[3]).powi(2)).sum()
    });
    assert!((2.0 * found[3] - of("ball").value.expect("a diameter")).abs() < 1e-5, "ball {}", 2.0 * found[3]);
    let ring = places(16..28);
    let circle = of("ring");
    let centre = Vector3::from(circle.position.expect("a centre"));
    let [a, b] = angles(circle.direction.expect("a normal").into());
    let found = least(&[centre.x + 2.0, centre.y - 1.0, centre.z, a + 0.02, b - 0.03, 100.0], 2.0, |p| {
        let n = unit(p[3], p[4]);
        let far = |x: &Vector3<f64>| {
            let v = x - Vector3::new(p[0], p[1], p[2]);
            let h = n.dot(&v);
            h * h + ((v - h * n).norm() - p[5]).powi(2)
        };
        ring.iter().map(far).sum()
    });
    assert!((2.0 * found[5] - circle.value.expect("a diameter")).abs() < 1e-5, "ring {}", 2.0 * found[5]);
    let pipe = places(28..46);
    let cylinder = of("pipe");
    let [a, b] = angles(cylinder.direction.expect("an axis").into());
    let foot = Vector3::from(cylinder.position.expect("a foot"));
    // An axis through a plane of constant z or x, whichever it crosses.
    let across = (0..3).max_by(|i, j| unit(a, b)[*i].abs().total_cmp(&unit(a, b)[*j].abs())).expect("three");
    let [i, j] = [(across + 1) % 3, (across + 2) % 3];
    let found = least(&[foot[i] + 2.0, foot[j] - 2.0, a + 0.02, b - 0.02, 75.0], 2.0, |p| {
        let n = unit(p[2], p[3]);
        let mut at = foot;
        (at[i], at[j]) = (p[0], p[1]);
        pipe.iter().map(|x| (n.cross(&(x - at)).norm() - p[4]).powi(2)).sum()
    });
    assert!((2.0 * found[4] - cylinder.value.expect("a diameter")).abs() < 1e-5, "pipe {}", 2.0 * found[4]);
}

#[test]
fn features_measured_later_are_those_of_the_adjustment() {
    let project = network(DatumKind::Free, 2);
    let with = adjusted(&project);
    let bare = Project { features: vec![], systems: vec![], ..project.clone() };
    let later = measured(&project, &adjusted(&bare)).expect("measured");
    assert_eq!(later.features.len(), project.features.len());
    for (a, b) in later.features.iter().flat_map(figures).zip(with.features.iter().flat_map(figures)) {
        assert!((a.1 - b.1).abs() < 1e-6, "{}: {} {}", a.0, a.1, b.1);
        assert!((a.2.expect("sigma") / b.2.expect("sigma") - 1.0).abs() < 1e-5, "{}", a.0);
    }
    assert_eq!(later.systems.len(), 4);
    let text = serde_json::to_string(&project).expect("json");
    assert_eq!(serde_json::from_str::<Project>(&text).expect("the same"), project);
}

#[test]
fn what_cannot_be_measured_says_why_and_the_rest_goes_on() {
    let mut project = network(DatumKind::Free, 0);
    project.systems.clear();
    let points = |range| FeatureKind::Plane { points: named(range) };
    project.features = vec![
        feature("two", points(0..2)),
        feature("on a line", points(0..4)),
        feature("gone", FeatureKind::Plane { points: vec!["p0".into(), "p1".into(), "p6".into(), "nobody".into()] }),
        feature("flat ball", FeatureKind::Sphere { points: vec!["p0".into(), "p0".into(), "p1".into(), "p1".into()] }),
        feature("on two", FeatureKind::Distance { from: End::Feature("two".into()), to: End::Point("p9".into()) }),
        feature("nowhere", FeatureKind::Distance { from: End::Point("nobody".into()), to: End::Point("p9".into()) }),
        feature(
            "of a distance",
            FeatureKind::Distance { from: End::Feature("on two".into()), to: End::Point("p9".into()) },
        ),
        feature(
            "no direction",
            FeatureKind::Angle { from: End::Point("p1".into()), at: None, to: End::Feature("gone".into()) },
        ),
        feature("nothing", FeatureKind::Distance { from: End::Point("p1".into()), to: End::Point("p1".into()) }),
        feature("length", FeatureKind::Distance { from: End::Point("p1".into()), to: End::Point("p2".into()) }),
    ];
    // Exactly on a line, whatever the noise.
    let adjustment = adjusted(&project);
    let mut points = adjustment.points.clone();
    for k in 0..4 {
        points[k].xyz = [k as f64, 2.0 * k as f64, -(k as f64)];
    }
    let found = measure(&project, &points, &adjustment.photos, &mut |_| Ok(None)).expect("told").features;
    let said = |id: &str| {
        let f = found.iter().find(|f| f.id == id).expect("told");
        f.error.as_ref().map(|e| e.detail().expect("a reason")).unwrap_or_default()
    };
    assert!(said("two").contains("determines: 2, needed: 3"), "{}", said("two"));
    assert!(said("on a line").contains("on one line"));
    assert_eq!((said("gone").as_str(), &found[2].missing), ("", &vec!["nobody".to_owned()]));
    assert!(said("flat ball").contains("needed: 4"));
    assert!(said("on two").contains("\"two\""));
    assert!(said("nowhere").contains("nobody"));
    assert!(said("of a distance").contains("not fitted"));
    assert!(said("no direction").contains("two directions"));
    assert_eq!((found[8].value, found[8].sigma), (Some(0.0), None));
    assert!(found[9].value.expect("a length") > 0.0);
    project.features = vec![feature("a", points_of(0..3)), feature("a", points_of(0..3))];
    assert_eq!(project.validate().expect_err("twice").code(), "duplicate");
    project.features =
        vec![feature("a", FeatureKind::Distance { from: End::Feature("b".into()), to: End::Point("p1".into()) })];
    assert_eq!(project.validate().expect_err("unknown").code(), "unknown");
}

fn points_of(range: std::ops::Range<usize>) -> FeatureKind {
    FeatureKind::Plane { points: named(range) }
}

/// The pipe's points were set every 0.7 radians and 9 units along it: unrolled, they lie so.
#[test]
fn deviations_are_drawn_where_the_points_lie_on_the_form_laid_flat() {
    let mut project = network(DatumKind::Free, 0);
    project.features = vec![
        feature("A", FeatureKind::Plane { points: named(0..16) }),
        feature("B", FeatureKind::Cylinder { points: named(28..46) }),
        feature("C", FeatureKind::Deviations { feature: Some("A".into()), points: named(16..28), given: Vec::new() }),
        feature("D", FeatureKind::Circle { points: named(16..28) }),
        feature("E", FeatureKind::Distance { from: End::Point("p0".into()), to: End::Point("p1".into()) }),
    ];
    let adjustment = adjust(&project, &AdjustOptions::default(), &mut |_| true).expect("adjusts");
    let plots = sightline_report::plots::plots(&project, Some(&adjustment)).expect("plots");
    let of = |id: &str| {
        let name = sightline_report::plots::deviations_name(id);
        plots.iter().find(|plot| plot.name == name).map(|plot| plot.svg.as_str())
    };
    assert!(of("E").is_none(), "a distance has no deviations");
    let path = |svg: &str, class: &str| {
        let element = svg.split(&format!("<path class=\"{class}\"")).nth(1).unwrap_or_default();
        element.split(" d=\"").nth(1).and_then(|d| d.split('"').next()).unwrap_or_default().to_owned()
    };
    for (id, points) in [("A", 16), ("B", 18), ("C", 12), ("D", 12)] {
        let svg = of(id).unwrap_or_else(|| panic!("no plot of {id}"));
        let sticks: usize = ["stick-a", "stick-b"].iter().map(|class| path(svg, class).matches('M').count()).sum();
        assert_eq!(sticks, points, "{id}");
    }
    let feet = path(of("B").expect("a plot"), "dot-c");
    let places: Vec<[f64; 2]> = feet
        .split('M')
        .filter(|foot| !foot.is_empty())
        .map(|foot| {
            let numbers: Vec<f64> = foot
                .split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-'))
                .filter_map(|number| number.parse().ok())
                .collect();
            [numbers[0], numbers[1]]
        })
        .collect();
    assert_eq!(places.len(), 18, "{feet}");
    let turn = 0.7 / std::f64::consts::TAU * 448.0;
    let step = |k: usize| (places[k + 1][0] - places[k][0]).rem_euclid(448.0);
    let forwards = (0..17).all(|k| (step(k) - turn).abs() < 2.0);
    let backwards = (0..17).all(|k| (448.0 - step(k) - turn).abs() < 2.0);
    assert!(forwards || backwards, "{places:?}");
    let up: Vec<f64> = (0..17).map(|k| places[k + 1][1] - places[k][1]).collect();
    assert!(up.iter().all(|u| (u - up[0]).abs() < 1.0 && u.abs() > 5.0), "{up:?}");
}
