//! Published statistics of two epochs, and two real bundles of one object.

use crate::support::data;
use sightline::monitoring::{
    DatumChoice, Epoch, ListedCovariance, ListedPoint, Monitoring, Options, Outcome, PairNote, VarianceChoice,
    VarianceUsed, compare_epochs,
};
use sightline_exchange::epochs;

/// An epoch of the wall: its plane coordinates at a height that is held.
fn wall(epoch: &serde_json::Value, name: &str) -> Epoch {
    let sigma0 = epoch["s0"].as_f64().unwrap();
    let ids: Vec<String> = epoch["points"].as_object().unwrap().keys().cloned().collect();
    let q: Vec<Vec<f64>> = serde_json::from_value(epoch["Q"].clone()).unwrap();
    let points = ids.iter().map(|id| {
        let [x, y]: [f64; 2] = serde_json::from_value(epoch["points"][id].clone()).unwrap();
        ListedPoint { id: id.clone(), xyz: [x, y, 0.0], sigma: None }
    });
    let value = |i: usize, j: usize| match i % 3 < 2 && j % 3 < 2 {
        true => sigma0 * sigma0 * q[i / 3 * 2 + i % 3][j / 3 * 2 + j % 3],
        false => 0.0,
    };
    let n = 3 * ids.len();
    Epoch {
        name: name.into(),
        points: Some(points.collect()),
        covariance: Some(ListedCovariance {
            points: ids,
            matrix: (0..n).map(|i| (0..n).map(|j| value(i, j)).collect()).collect(),
        }),
        sigma0: Some(sigma0),
        redundancy: epoch["redundancy"].as_f64(),
        unit: Some("m".into()),
        ..Epoch::default()
    }
}

/// The exercise holds each point against 2 F(2, f₁ + f₂) in the system of both epochs, each epoch with its own variance factor.
#[test]
fn the_wall_has_the_published_statistics() {
    let Some(text) = data::text("epochs/crown-wall.json") else { return };
    let file: serde_json::Value = serde_json::from_str(&text).unwrap();
    let epochs = [wall(&file["epochs"][0], "1"), wall(&file["epochs"][1], "2")];
    let options = Options {
        datum: DatumChoice::Given,
        variance: VarianceChoice::Separate,
        correction: sightline::monitoring::Correction::None,
        ..Options::default()
    };
    let found = compare_epochs(&epochs, &options).unwrap();
    let pair = &found.pairs[0];
    assert_eq!((pair.variance, pair.redundancy, pair.points.len()), (VarianceUsed::Separate, Some(292.0), 5));
    assert!(pair.variance_test.unwrap().passed);
    for point in &pair.points {
        let published = file["published_T"][&point.id].as_f64().unwrap();
        let test = point.test.unwrap();
        // T of the exercise is the quadratic form itself. Three digits are printed, some cut and some rounded.
        let t = test.statistic * test.f1;
        assert_eq!((test.f1, test.f2, test.passed), (2.0, Some(292.0), true));
        assert!((t - published).abs() < 0.001, "{}: {t} {published}", point.id);
        assert!((test.limit * test.f1 - 6.0534).abs() < 5e-5, "{}", test.limit * test.f1);
        // An independent program has one digit more.
        let again = [("901", 1.1946), ("902", 0.7334), ("903", 0.1582), ("904", 0.6142), ("905", 0.8819)];
        let expected = again.iter().find(|(id, _)| *id == point.id).unwrap().1;
        assert!((t - expected).abs() < 5.1e-5, "{}: {t}", point.id);
    }
    // In its own datum the wall is congruent too: 10 coordinates less 3 of the datum in the plane.
    let own = compare_epochs(&epochs, &Options::default()).unwrap();
    let test = own.pairs[0].global_test.unwrap();
    assert_eq!((test.f1, test.passed), (7.0, true));
}

/// Both bundles with the common codes as reference points; `scaled`: whether both scales are kept.
fn telescope(scaled: bool) -> Option<Monitoring> {
    let read = |name: &str, file: &str| -> Option<Epoch> {
        let text = data::text(&format!("epochs/{file}"))?;
        let points = epochs::points(&text, Default::default()).expect("a coordinate list").points;
        let scale = Some(scaled);
        Some(Epoch { name: name.into(), points: Some(points), unit: Some("mm".into()), scale, ..Epoch::default() })
    };
    let all = [read("1", "telescope-1.csv")?, read("2", "telescope-2.csv")?];
    let codes = |epoch: &Epoch| -> Vec<String> {
        epoch.points.iter().flatten().map(|p| p.id.clone()).filter(|id| id.starts_with("CODE")).collect()
    };
    let second = codes(&all[1]);
    let reference: Vec<String> = codes(&all[0]).into_iter().filter(|id| second.contains(id)).collect();
    assert_eq!(reference.len(), 117);
    Some(compare_epochs(&all, &Options { reference: Some(reference), ..Options::default() }).expect("comparable"))
}

/// With both scales kept the bundles differ by 11 ppm, nine standard errors; then CODE7 contributes most. CODE30, CODE168 and CODE106 moved
/// by less than their own stated standard errors along the displacement, or hardly more, and no test names them.
#[test]
fn two_bundles_of_a_telescope_are_told_apart() {
    let Some(found) = telescope(true) else { return };
    let pair = &found.pairs[0];
    let scale = pair.scale.unwrap();
    assert!((scale.value - 1.000_010_7).abs() < 1e-7 && !scale.test.passed && scale.test.statistic > 50.0);
    let global = pair.global_test.unwrap();
    assert_eq!((global.f1, global.f2, global.passed), (345.0, None, false));
    assert_eq!((pair.steps[0].removed.as_str(), pair.outcome), ("CODE7", Outcome::StableGroup));
    assert!(pair.unstable.iter().any(|id| id == "CODE29") && pair.stable.len() > 80);
    // The stated standard errors are too small, and no redundancy of the bundles is known for a test of their variance factors.
    assert!(pair.variance_test.is_none());
    let factor = pair.notes.iter().find_map(|note| match note {
        PairNote::SigmasTooSmall { factor } => Some(*factor),
        _ => None,
    });
    assert!(factor.is_some_and(|factor| (1.2..1.6).contains(&factor)), "{factor:?}");
    assert!(pair.notes.contains(&PairNote::ScaleDiffers));
    let point = |id: &str| pair.points.iter().find(|p| p.id == id).unwrap();
    // Lengths of a robust rigid fit by others; ours are in the datum of the stable codes.
    for (id, length) in [("CODE29", 5.22), ("CODE30", 1.48), ("CODE7", 0.82), ("CODE168", 0.47), ("CODE106", 0.41)] {
        let point = point(id);
        println!(
            "{id}: {:.3} ± {:.3} mm, T {:.2}",
            point.length,
            point.length_sigma.unwrap(),
            point.test.unwrap().statistic
        );
        assert!((point.length - length).abs() < 0.05, "{id}: {}", point.length);
    }
    assert!(point("CODE7").test.unwrap().statistic > 10.0 && point("CODE30").test.unwrap().passed);
    let matched = pair.points.iter().filter(|p| p.id.starts_with("TARGET")).count();
    println!("{matched} targets matched by position, {} left out", pair.left_out.len());
    assert!(matched > 1000 && pair.points.iter().all(|p| p.length < 10.0));

    // With the scale of one of them free the codes are congruent as a whole, and CODE7 is the second opinion's.
    let free = &telescope(false).unwrap().pairs[0];
    assert_eq!((free.outcome, free.scale), (Outcome::Congruent, None));
    assert!(free.robust_datum.unstable.iter().any(|id| id == "CODE7"));
    assert!(free.notes.iter().any(|note| matches!(note, PairNote::SecondOpinionDiffers { .. })));
}
