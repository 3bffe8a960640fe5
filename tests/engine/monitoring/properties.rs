//! What must not change anything: the order of points, which epoch is the first, the systems and datums of the epochs.

use crate::support::epochs::{Made, SIGMA, direction, epoch, object, references};
use nalgebra::{DMatrix, Matrix3, Rotation3, Vector3};
use sightline::monitoring::{
    Epoch, Group, GroupModel, LeftOutPointReason, Limits, Monitoring, Options, Pair, ThresholdState, Thresholds,
    compare_epochs,
};
use sightline::noise::Noise;

const SEEDS: u64 = 12;

/// A pair with some movement: a reference point and two object points, and a group.
fn pair_of(seed: u64) -> ([Epoch; 2], Options) {
    let object = object(500 + seed, 8, 6);
    let mut noise = Noise::new(seed, 5);
    let mut far = |k: usize, sigmas: f64| (k, direction(&mut noise) * sigmas * SIGMA);
    let moved =
        if seed.is_multiple_of(3) { vec![] } else { vec![far(seed as usize % 8, 25.0), far(9, 40.0), far(11, 6.0)] };
    let first = epoch("0", &object, &[], &Made { turned: false, ..Made::new(7000 + 2 * seed) });
    let second = epoch("1", &object, &moved, &Made { turned: false, ..Made::new(7001 + 2 * seed) });
    let models = [GroupModel::Rigid, GroupModel::Similarity, GroupModel::Affine];
    let group =
        Group { name: "g".into(), points: (0..5).map(|k| format!("o{k}")).collect(), model: models[seed as usize % 3] };
    ([first, second], Options { reference: Some(references(8)), groups: vec![group], ..Options::default() })
}

fn compared(epochs: &[Epoch], options: &Options) -> Monitoring {
    compare_epochs(epochs, options).expect("comparable")
}

/// Two results that are one, points by their names.
fn alike(a: &Pair, b: &Pair, tolerance: f64, turn: &Matrix3<f64>, sign: f64, what: &str) {
    let near = |p: f64, q: f64, size: f64| assert!((p - q).abs() <= tolerance * size, "{what}: {p} {q}");
    let names = |ids: &[String]| {
        let mut ids = ids.to_vec();
        ids.sort();
        ids
    };
    assert_eq!(names(&a.stable), names(&b.stable), "{what}");
    let removed = |pair: &Pair| pair.steps.iter().map(|s| s.removed.clone()).collect::<Vec<_>>();
    assert_eq!(removed(a), removed(b), "{what}");
    let (t, u) = (a.global_test.unwrap(), b.global_test.unwrap());
    assert_eq!((t.f1, t.f2.is_some()), (u.f1, u.f2.is_some()));
    near(t.statistic, u.statistic, 1.0 + t.statistic);
    for p in &a.points {
        let q = b.points.iter().find(|q| q.id == p.id).unwrap();
        let d = turn * Vector3::from(p.difference) * sign;
        (0..3).for_each(|axis| near(d[axis], q.difference[axis], SIGMA));
        let sigma = p.length_sigma.unwrap();
        near(sigma, q.length_sigma.unwrap(), sigma);
        near(p.test.unwrap().statistic, q.test.unwrap().statistic, 1.0 + p.test.unwrap().statistic);
        let worst = p.detectable.unwrap().worst;
        near(worst, q.detectable.unwrap().worst, worst);
        assert_eq!((p.moved, p.role), (q.moved, q.role), "{what}");
    }
    for (g, h) in a.groups.iter().zip(&b.groups) {
        assert_eq!(g.error, h.error);
        near(g.test.unwrap().statistic, h.test.unwrap().statistic, 1.0 + g.test.unwrap().statistic);
    }
}

#[test]
fn the_order_of_points_changes_nothing() {
    for seed in 0..SEEDS {
        let (epochs, options) = pair_of(seed);
        let mut mixed = epochs.clone();
        for (k, epoch) in mixed.iter_mut().enumerate() {
            let points = epoch.points.as_mut().unwrap();
            points.reverse();
            points.rotate_left(3 + k);
            let covariance = epoch.covariance.as_mut().unwrap();
            let n = covariance.points.len();
            let order: Vec<usize> = (0..n).map(|i| (5 * i + k) % n).collect();
            let old = covariance.clone();
            covariance.points = order.iter().map(|&i| old.points[i].clone()).collect();
            let at = |i: usize| 3 * order[i / 3] + i % 3;
            covariance.matrix = (0..3 * n).map(|i| (0..3 * n).map(|j| old.matrix[at(i)][at(j)]).collect()).collect();
        }
        let (a, b) = (compared(&epochs, &options), compared(&mixed, &options));
        alike(&a.pairs[0], &b.pairs[0], 1e-7, &Matrix3::identity(), 1.0, &format!("order, {seed}"));
    }
}

#[test]
fn exchanged_epochs_give_negated_differences() {
    for seed in 0..SEEDS {
        let (epochs, options) = pair_of(seed);
        let [first, second] = epochs.clone();
        let (a, b) = (compared(&epochs, &options), compared(&[second, first], &options));
        // The systems of both differ by some 10⁻⁵ of a turn, and so do the differences.
        alike(&a.pairs[0], &b.pairs[0], 2e-3, &Matrix3::identity(), -1.0, &format!("exchanged, {seed}"));
        let (v, w) = (a.pairs[0].variance_test.unwrap(), b.pairs[0].variance_test.unwrap());
        assert!((v.statistic * w.statistic - 1.0).abs() < 1e-9 && (v.p - w.p).abs() < 1e-9 && v.passed == w.passed);
        let (s, t) = (a.pairs[0].scale.unwrap(), b.pairs[0].scale.unwrap());
        assert!((s.value * t.value - 1.0).abs() < 1e-8 && (s.test.statistic - t.test.statistic).abs() < 1e-3);
    }
}

/// The covariance of coordinates in the datum of some of the points only: singular, and of another size.
///
/// Directions of a datum are those at the middle of both epochs, where the comparison takes them: at the places of one epoch they
/// differ by its movement over the extent of the object, and the covariances by that times the weakness of the datum.
fn in_other_datum(epoch: &Epoch, places: &[Vector3<f64>], carriers: &[usize]) -> Epoch {
    let points = epoch.points.as_ref().unwrap();
    let n = points.len();
    let centre = carriers.iter().map(|&k| places[k]).sum::<Vector3<f64>>() / carriers.len() as f64;
    let mut g = DMatrix::zeros(3 * n, 6);
    for (k, place) in places.iter().enumerate() {
        let x = (place - centre) / 1000.0;
        g.fixed_view_mut::<3, 3>(3 * k, 0).fill_with_identity();
        g.fixed_view_mut::<3, 3>(3 * k, 3).copy_from(&-x.cross_matrix());
    }
    let mut d = DMatrix::zeros(3 * n, 6);
    for &k in carriers {
        d.view_mut((3 * k, 0), (3, 6)).copy_from(&g.view((3 * k, 0), (3, 6)));
    }
    let m = (d.transpose() * &g).try_inverse().unwrap() * d.transpose();
    let s = DMatrix::identity(3 * n, 3 * n) - &g * m;
    let stated = epoch.covariance.as_ref().unwrap();
    let c = DMatrix::from_fn(3 * n, 3 * n, |i, j| stated.matrix[i][j]);
    let c = &s * c * s.transpose();
    let mut other = epoch.clone();
    other.covariance.as_mut().unwrap().matrix = c.row_iter().map(|row| row.iter().copied().collect()).collect();
    other
}

fn turned(epoch: &Epoch, seed: u64) -> (Epoch, Matrix3<f64>) {
    let mut noise = Noise::new(seed, 6);
    let turn = *Rotation3::new(Vector3::from_fn(|_, _| noise.normal())).matrix();
    let shift = Vector3::from_fn(|_, _| 2e4 * noise.normal());
    let mut other = epoch.clone();
    other.points.as_mut().unwrap().iter_mut().for_each(|p| p.xyz = (turn * Vector3::from(p.xyz) + shift).into());
    let stated = other.covariance.as_mut().unwrap();
    let n = stated.matrix.len();
    let wide = DMatrix::from_fn(n, n, |i, j| if i / 3 == j / 3 { turn[(i % 3, j % 3)] } else { 0.0 });
    let c = &wide * DMatrix::from_fn(n, n, |i, j| stated.matrix[i][j]) * wide.transpose();
    stated.matrix = c.row_iter().map(|row| row.iter().copied().collect()).collect();
    (other, turn)
}

#[test]
fn the_datum_of_the_epochs_does_not_matter() {
    for seed in 0..SEEDS {
        let (epochs, options) = pair_of(seed);
        let a = compared(&epochs, &options);
        let xyz = |e: usize, k: usize| Vector3::from(epochs[e].points.as_ref().unwrap()[k].xyz);
        let places: Vec<_> = (0..14).map(|k| (xyz(0, k) + xyz(1, k)) * 0.5).collect();
        let other =
            [in_other_datum(&epochs[0], &places, &[1, 4, 9]), in_other_datum(&epochs[1], &places, &[0, 2, 3, 7, 12])];
        let b = compared(&other, &options);
        // Both systems differ by some 10⁻⁵ of a turn.
        alike(&a.pairs[0], &b.pairs[0], 2e-4, &Matrix3::identity(), 1.0, &format!("datum, {seed}"));
        let (later, _) = turned(&other[1], seed);
        let c = compared(&[other[0].clone(), later], &options);
        alike(&a.pairs[0], &c.pairs[0], 5e-4, &Matrix3::identity(), 1.0, &format!("system of the later, {seed}"));
        let (earlier, turn) = turned(&other[0], seed + 50);
        let d = compared(&[earlier, other[1].clone()], &options);
        alike(&a.pairs[0], &d.pairs[0], 5e-4, &turn, 1.0, &format!("system of the earlier, {seed}"));
    }
}

/// Numbers given by a program are matched by position, and what is ambiguous is listed.
#[test]
fn numbered_points_are_matched_by_position() {
    for seed in 0..SEEDS {
        let mut object = object(900 + seed, 8, 30);
        object.iter_mut().skip(8).enumerate().for_each(|(k, (id, _))| *id = format!("u{k}"));
        // Two that stand closer than they could be distinguished by their positions.
        let beside = object[8].1 + Vector3::new(0.3, 0.0, 0.0);
        object[9].1 = beside;
        let mut renumbered = object.clone();
        let n = renumbered.len() - 8;
        (0..n).for_each(|k| renumbered[8 + k].0 = format!("u{}", (k + 7) % n));
        renumbered.pop();
        let moved = [(8, Vector3::new(0.25, 0.0, 0.0)), (20, Vector3::new(0.2, 0.2, 0.0))];
        let first = epoch("0", &object, &[], &Made::new(40 + seed));
        let second = epoch("1", &renumbered, &moved, &Made::new(4000 + seed));
        let found = compared(&[first, second], &Options { reference: Some(references(8)), ..Options::default() });
        let pair = &found.pairs[0];
        for point in pair.points.iter().filter(|p| p.id.starts_with('u')) {
            let k: usize = point.id[1..].parse().unwrap();
            let later = point.later_id.as_ref().unwrap_or(&point.id);
            assert_eq!(*later, format!("u{}", (k + 7) % n), "{seed}");
            assert!(point.length < 1.0);
        }
        let reason = |id: &str, epoch: &str| {
            let at = |e: &String| e == epoch;
            pair.left_out.iter().any(|l| {
                l.id == id
                    && match &l.reason {
                        LeftOutPointReason::Ambiguous { epoch, candidates } => at(epoch) && !candidates.is_empty(),
                        LeftOutPointReason::NoCounterpart { epoch } => at(epoch),
                        _ => false,
                    }
            })
        };
        assert!(reason("u7", "1") && reason("u8", "1"), "{seed}: {:?}", pair.left_out);
        assert!(reason("u29", "0"), "{seed}: {:?}", pair.left_out);
        assert_eq!(pair.points.len(), 8 + 30 - 3, "{seed}");
        // Without the prefix a number is an identity.
        let named = Options { automatic: Vec::new(), reference: Some(references(8)), ..Options::default() };
        let made =
            [epoch("0", &object, &[], &Made::new(40 + seed)), epoch("1", &renumbered, &[], &Made::new(4000 + seed))];
        let found = compared(&made, &named);
        assert!(found.pairs[0].points.iter().any(|p| p.length > 10.0));
    }
}

/// Points that move steadily have that velocity; its standard error is that of the draws, and thresholds tell the state.
#[test]
fn velocities_have_their_standard_errors() {
    let (mut squares, mut count, mut rejected, mut tested) = (0.0, 0, 0, 0);
    let rate = Vector3::new(0.01, -0.02, 0.005);
    for seed in 0..40 {
        let object = object(seed, 6, 4);
        let days = ["2026-01-01", "2026-01-11", "2026-02-10", "2026-03-02", "2026-04-11"];
        let passed = [0.0, 10.0, 40.0, 60.0, 100.0];
        let epochs: Vec<Epoch> = (0..5)
            .map(|k| {
                let moved = [(7, rate * passed[k])];
                let made = Made { turned: k % 2 == 1, ..Made::new(900 + 10 * seed + k as u64) };
                Epoch { date: Some(days[k].into()), ..epoch(&k.to_string(), &object, &moved, &made) }
            })
            .collect();
        let thresholds = Thresholds {
            all: Limits { warning: 0.9, alarm: 1.5 },
            points: [("o0".to_owned(), Limits { warning: 1e-9, alarm: 100.0 })].into(),
            groups: Default::default(),
        };
        let options = Options { reference: Some(references(6)), thresholds: Some(thresholds), ..Options::default() };
        let found = compared(&epochs, &options);
        assert_eq!(found.pairs.len(), 4 + 3);
        let series = |id: &str| found.series.iter().find(|s| s.id == id).unwrap();
        if found.series_datum.len() < 4 {
            assert!(series("o1").velocity.is_none());
            continue;
        }
        let moving = series("o1");
        assert_eq!((moving.values.len(), moving.state), (4, Some(ThresholdState::Alarm)));
        assert!(!moving.velocity_test.unwrap().passed);
        let (v, s) = (moving.velocity.unwrap(), moving.velocity_sigma.unwrap());
        squares += (0..3).map(|a| ((v[a] - rate[a]) / s[a]).powi(2)).sum::<f64>();
        count += 3;
        assert_eq!(
            (series("o0").state, series("o2").state),
            (Some(ThresholdState::Warning), Some(ThresholdState::Quiet))
        );
        tested += 1;
        rejected += usize::from(!series("o3").velocity_test.unwrap().passed);
    }
    let ratio = squares / f64::from(count);
    println!("velocities: mean square over variance {ratio:.3}; {rejected} of {tested} at rest rejected");
    assert!((0.65..1.45).contains(&ratio) && tested > 20, "{ratio} {tested}");
    assert!(crate::support::epochs::band(tested, 0.05).contains(&rejected), "{rejected}");
}

/// 200 points, 12 epochs, full covariances: it ends, and every epoch has its verdict.
#[test]
fn two_hundred_points_through_twelve_epochs() {
    let object = object(3, 12, 188);
    let epochs: Vec<Epoch> = (0..12)
        .map(|k| {
            let moved = [(50, Vector3::new(0.1 * k as f64, 0.0, 0.0))];
            let made = Made { turned: false, redundancy: 2000, ..Made::new(60 + k) };
            let made = epoch(&k.to_string(), &object, &moved, &made);
            Epoch { date: Some(format!("2026-{:02}-01", k + 1)), ..made }
        })
        .collect();
    let began = std::time::Instant::now();
    let found = compared(&epochs, &Options { reference: Some(references(12)), ..Options::default() });
    println!("200 points x 12 epochs: {:.2} s", began.elapsed().as_secs_f64());
    assert_eq!((found.pairs.len(), found.series.len()), (11 + 10, 200));
    assert!(found.pairs[10].points[50].moved && found.series[50].values.len() == 11);
}
