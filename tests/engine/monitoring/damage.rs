//! Bad input: each kind is an error or a listed point, with a code.

use crate::support::epochs::{Made, epoch, object, references};
use sightline::adjustment::{Adjustment, Termination};
use sightline::error::{Error, Reason};
use sightline::monitoring::{Epoch, LeftOutPointReason, ListedPoint, Options, Outcome, compare_epochs};
use sightline::project::Project;

fn pair() -> [Epoch; 2] {
    let object = object(77, 8, 5);
    [epoch("0", &object, &[], &Made::new(1)), epoch("1", &object, &[], &Made::new(2))]
}

fn options() -> Options {
    Options { reference: Some(references(8)), ..Options::default() }
}

#[track_caller]
fn refused(epochs: &[Epoch], options: &Options, field: &str) -> Reason {
    match compare_epochs(epochs, options) {
        Err(Error::Invalid { reason, at }) => {
            assert_eq!(at.field.as_deref(), Some(field), "{reason:?}");
            assert!(!reason.to_string().is_empty());
            reason
        }
        other => panic!("{other:?}"),
    }
}

fn points(epoch: &mut Epoch) -> &mut Vec<ListedPoint> {
    epoch.points.as_mut().unwrap()
}

#[test]
fn a_sound_pair_is_congruent() {
    let found = compare_epochs(&pair(), &options()).unwrap();
    assert_eq!((found.unit.as_deref(), found.pairs.len()), (Some("mm"), 1));
    assert!(found.pairs[0].outcome != Outcome::NoStableGroup);
    let text = serde_json::to_string(&found).unwrap();
    assert_eq!(serde_json::from_str::<sightline::monitoring::Monitoring>(&text).unwrap(), found);
}

#[test]
fn epochs_that_cannot_be_compared_are_refused_with_a_reason() {
    let one = pair()[..1].to_vec();
    assert!(matches!(refused(&one, &options(), "epochs"), Reason::EpochsCount { given: 1, .. }));

    let mut e = pair();
    e[1].unit = Some("m".into());
    assert!(matches!(refused(&e, &options(), "epochs[1].unit"), Reason::EpochUnit { .. }));
    e[1].unit = Some("millimetres".into());
    let unknown = compare_epochs(&e, &options());
    assert!(unknown.is_ok() || matches!(unknown, Err(Error::Invalid { reason: Reason::EpochUnit { .. }, .. })));

    // Other numbers without a word.
    let mut e = pair();
    e[1].unit = None;
    points(&mut e[1]).iter_mut().for_each(|p| p.xyz = p.xyz.map(|x| x / 1000.0));
    e[1].covariance.as_mut().unwrap().matrix.iter_mut().flatten().for_each(|c| *c *= 1e-6);
    let Reason::EpochUnitRatio { ratio, .. } = refused(&e, &options(), "epochs[1]") else { panic!() };
    assert!((ratio.0 - 0.001).abs() < 1e-5);
    // Without a scale of its own it is another matter.
    e[1].scale = Some(false);
    let found = compare_epochs(&e, &options()).unwrap();
    assert!(found.pairs[0].scale.is_none() && found.pairs[0].points.iter().all(|p| p.length < 1.0));

    for axis in 0..3 {
        let mut e = pair();
        points(&mut e[1]).iter_mut().for_each(|p| p.xyz[axis] = -p.xyz[axis]);
        assert!(matches!(refused(&e, &options(), "epochs[1]"), Reason::EpochMirrored { .. }), "{axis}");
    }

    let mut e = pair();
    let n = points(&mut e[1]).len();
    let ids: Vec<String> = points(&mut e[1]).iter().map(|p| p.id.clone()).collect();
    (0..n).for_each(|k| points(&mut e[1])[k].id = ids[(k + 3) % n].clone());
    assert!(matches!(refused(&e, &options(), "epochs[1]"), Reason::EpochUnlike { .. }));

    let mut e = pair();
    e[1].covariance = None;
    points(&mut e[1]).iter_mut().for_each(|p| (p.id, p.sigma) = (format!("x{}", p.id), Some([0.1; 3])));
    assert!(matches!(refused(&e, &Options::default(), "epochs[1]"), Reason::EpochNoCommon { .. }));

    let few = Options { reference: Some(references(3)), ..Options::default() };
    assert!(matches!(refused(&pair(), &few, "epochs[1]"), Reason::EpochReference { given: 3, needed: 4, .. }));

    let mut e = pair();
    e.iter_mut()
        .for_each(|e| points(e).iter_mut().take(8).enumerate().for_each(|(k, p)| p.xyz = [k as f64 * 100.0, 5.0, 5.0]));
    assert!(matches!(refused(&e, &options(), "epochs[1]"), Reason::EpochReferenceLine));

    let mut e = pair();
    e[0].covariance = None;
    assert!(matches!(refused(&e, &options(), "epochs[0].points"), Reason::EpochNoSigmas { .. }));

    let mut e = pair();
    e[1].project = Some(Project::default());
    assert!(matches!(refused(&e, &options(), "epochs[1]"), Reason::EpochSource { .. }));
    e[1] = Epoch { name: "1".into(), ..Epoch::default() };
    assert!(matches!(refused(&e, &options(), "epochs[1]"), Reason::EpochSource { .. }));

    let mut e = pair();
    let termination = Termination::IterationLimit;
    let adjustment = Some(Adjustment { termination, ..Adjustment::default() });
    e[1] = Epoch { name: "1".into(), project: Some(Project::default()), adjustment, ..Epoch::default() };
    assert!(matches!(refused(&e, &options(), "epochs[1].adjustment"), Reason::EpochNotConverged { .. }));

    let mut e = pair();
    e[1].date = Some("14.3.2026".into());
    assert!(matches!(refused(&e, &options(), "epochs[1].date"), Reason::EpochDate { .. }));

    let mut e = pair();
    e[1].name = "0".into();
    assert!(matches!(compare_epochs(&e, &options()), Err(Error::Duplicate { .. })));
    let unknown = Options { reference: Some(vec!["r0".into(), "nowhere".into()]), ..Options::default() };
    assert!(matches!(compare_epochs(&pair(), &unknown), Err(Error::Unknown { .. })));
}

#[test]
fn matrices_that_are_no_covariance_are_refused() {
    let with = |change: &dyn Fn(&mut Vec<Vec<f64>>)| {
        let mut e = pair();
        change(&mut e[1].covariance.as_mut().unwrap().matrix);
        compare_epochs(&e, &options())
    };
    let reason = |found| match found {
        Err(Error::Invalid { reason, .. }) => reason,
        other => panic!("{other:?}"),
    };
    assert!(matches!(
        reason(with(&|m| {
            m.pop();
        })),
        Reason::EpochMatrix { .. }
    ));
    assert!(matches!(
        reason(with(&|m| {
            m[4].pop();
        })),
        Reason::EpochMatrix { .. }
    ));
    assert!(matches!(reason(with(&|m| m[5][5] = -m[5][5])), Reason::EpochNotCovariance));
    assert!(matches!(reason(with(&|m| m[5][7] += 1.0)), Reason::EpochNotCovariance));
    assert!(matches!(reason(with(&|m| m[5][7] = f64::NAN)), Reason::EpochNotCovariance));
    let (i, j) = (3, 8);
    let too_large = |m: &mut Vec<Vec<f64>>| {
        let value = 1.5 * (m[i][i] * m[j][j]).sqrt();
        (m[i][j], m[j][i]) = (value, value);
    };
    assert!(matches!(reason(with(&too_large)), Reason::EpochNotCovariance));
    // The triangle is the same, short or with zeros.
    let full = compare_epochs(&pair(), &options()).unwrap();
    for zeros in [false, true] {
        let cut = with(&|m| {
            m.iter_mut().enumerate().for_each(|(k, row)| match zeros {
                true => row.iter_mut().skip(k + 1).for_each(|c| *c = 0.0),
                false => row.truncate(k + 1),
            });
        });
        let (a, b) = (&full.pairs[0].points[3], &cut.unwrap().pairs[0].points[3]);
        assert!((a.sigma[0] - b.sigma[0]).abs() < 1e-12, "{zeros}");
    }
}

#[test]
fn what_is_left_out_is_listed() {
    let mut e = pair();
    points(&mut e[1]).remove(12);
    let stated = e[1].covariance.as_mut().unwrap();
    stated.points.truncate(11);
    stated.matrix.truncate(33);
    stated.matrix.iter_mut().for_each(|row| row.truncate(33));
    let ignoring = Options { ignored: vec!["o1".into()], ..options() };
    let found = compare_epochs(&e, &ignoring).unwrap();
    let reason = |id: &str| &found.pairs[0].left_out.iter().find(|l| l.id == id).unwrap().reason;
    assert_eq!(reason("o4"), &LeftOutPointReason::OnlyIn { epoch: "0".into() });
    assert_eq!(reason("o3"), &LeftOutPointReason::NoSigma { epoch: "1".into() });
    assert_eq!(reason("o1"), &LeftOutPointReason::Ignored);
    assert_eq!((found.pairs[0].left_out.len(), found.pairs[0].points.len()), (3, 10));
}

#[test]
fn options_out_of_range_are_refused() {
    for (field, options) in [
        ("significance", Options { significance: 0.0, ..options() }),
        ("significance", Options { significance: f64::NAN, ..options() }),
        ("power", Options { power: 1.0, ..options() }),
    ] {
        refused(&pair(), &options, field);
    }
}
