//! The report: every section is there in both languages, with the result's numbers to the printed digit, and nothing in it runs.

use sightline_report::reason::ReportReason;
use std::collections::BTreeMap;

use crate::support::networks::{Wanted, brown, exact, noisy};
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Adjustment, Quantity};
use sightline::comparison::compare;
use sightline::error::{Error, Lack};
use sightline::noise::Noise;
use sightline::project::{
    CoordinateSystem, DatumKind, Distance, End, Feature, FeatureKind, LengthLimit, Paper, Parameter, Project,
    RemovedFields, ReportLanguage, ReportSettings, Role, Section, SystemKind,
};
use sightline_exchange as exchange;
use sightline_report::number::{count, decimals_for, fixed, with_sigma};
use sightline_report::plots::{comparison, plots};
use sightline_report::{digest, files, sha256};

/// A network with everything that a report shows.
fn project() -> Project {
    let wanted = Wanted {
        photos: 8,
        points: 30,
        datum: DatumKind::Control,
        control: (6, 0.05),
        distances: (2, 0.02),
        cameras: vec![brown(&[Parameter::C, Parameter::X0, Parameter::Y0, Parameter::K1, Parameter::K2])],
        ..Wanted::default()
    };
    let mut project = noisy(&exact(&wanted, 11), &mut Noise::new(5, 0));
    project.name = "Panel <b>\"7\"".into();
    for k in [10, 11] {
        let truth = exact(&wanted, 11).points[k].clone();
        project.points[k].xyz = truth.xyz;
        project.points[k].role = Role::Check;
    }
    let place = |id: &str| exact(&wanted, 11).points.iter().find(|p| p.id == id).and_then(|p| p.xyz).expect("known");
    for (from, to) in [("p12", "p13"), ("p14", "p15")] {
        let (a, b) = (place(from), place(to));
        let length = (a[0] - b[0]).hypot(a[1] - b[1]).hypot(a[2] - b[2]);
        project.distances.push(Distance { from: from.into(), to: to.into(), length, sigma: 0.01, check: true });
    }
    let end = |id: &str| End::Point(id.into());
    let points: Vec<String> = ["p12", "p13", "p14", "p15"].map(str::to_owned).into();
    let feature = |id: &str, kind| Feature { id: id.into(), kind };
    project.features = vec![
        feature("Base <i>", FeatureKind::Plane { points: points.clone() }),
        feature("B", FeatureKind::Distance { from: end("p12"), to: end("p13") }),
        feature("C", FeatureKind::Angle { from: end("p12"), at: Some(end("p13")), to: end("p14") }),
        feature("D", FeatureKind::Line { points: vec!["p12".into()] }),
    ];
    project.systems = vec![CoordinateSystem { id: "S".into(), kind: SystemKind::Automatic { points } }];
    project.observations[3].enabled = false;
    project.photos[0].sha256 = sha256(b"a photo");
    project.report = ReportSettings {
        operator: "Measuring crew".into(),
        date: "2026-11-22".into(),
        text: "First line\nsecond line".into(),
        left_out: Vec::new(),
        length_limit: Some(LengthLimit { constant: 0.5, per: Some(10_000.0) }),
        ..ReportSettings::default()
    };
    project
}

fn adjusted(project: &Project) -> Adjustment {
    let options = AdjustOptions { snooping: true, ..AdjustOptions::default() };
    adjust(project, &options, &mut |_| true).expect("solvable")
}

fn html(project: &Project, adjustment: &Adjustment) -> String {
    let files = files::export("report", project, Some(adjustment), false).expect("a report");
    let names: Vec<&String> = files.keys().collect();
    assert_eq!(names, ["report.html"]);
    String::from_utf8(files["report.html"].clone()).expect("UTF-8")
}

/// The text of each section, tags taken away.
fn sections(html: &str) -> BTreeMap<String, String> {
    let parts = html.split("<section data-section=\"").skip(1);
    let one = |part: &str| {
        let (name, rest) = part.split_once("\">").expect("a name");
        (name.to_owned(), plain(rest.split("</section>").next().expect("an end")))
    };
    parts.map(one).collect()
}

fn plain(html: &str) -> String {
    let mut text = String::new();
    let mut inside = false;
    for c in html.chars() {
        match c {
            '<' => inside = true,
            '>' => {
                inside = false;
                text.push(' ');
            }
            c if !inside => text.push(c),
            _ => {}
        }
    }
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn every_section_is_there_with_the_results_own_numbers() {
    let mut project = project();
    let adjustment = adjusted(&project);
    for (language, paper) in [(ReportLanguage::English, Paper::A4), (ReportLanguage::Korean, Paper::Letter)] {
        (project.report.language, project.report.paper) = (Some(language), paper);
        let html = html(&project, &adjustment);
        let all = sections(&html);
        assert_eq!(all.len(), Section::ALL.len(), "{:?}", all.keys());
        assert!(html.contains(if paper == Paper::A4 { "size: A4" } else { "size: letter" }));
        let precision = adjustment.precision.as_ref().expect("statistics");
        let decimals = decimals_for(precision.rms_sigma.into_iter().fold(f64::INFINITY, f64::min));
        for point in &adjustment.points {
            let numbers = point.xyz.into_iter().chain(point.sigma.expect("statistics")).map(|x| fixed(x, decimals));
            let row = numbers.collect::<Vec<_>>().join(" ");
            assert!(all["points"].contains(&format!("{} {row}", count(point.rays))), "{} {row}", point.id);
        }
        for (parameter, sigma) in &adjustment.cameras[0].sigma {
            let value = adjustment.cameras[0].camera.interior.get(*parameter).expect("of the model");
            let (value, sigma, _) = with_sigma(value, Some(*sigma));
            assert!(all["cameras"].contains(&format!("{value} {sigma}")), "{parameter} {value} {sigma}");
        }
        let check = adjustment.check_statistics.as_ref().expect("check points");
        let unit = &project.unit;
        assert!(all["lengths"].contains(&format!("0.5 {unit} + L / 10 000")), "{}", all["lengths"]);
        assert!(all["control"].contains(&fixed(check.rms_all, decimals)));
        assert!(all["statistics"].contains(&fixed(adjustment.sigma0.expect("redundant"), 4)));
        assert!(all["settings"].contains(&sha256(b"a photo")) && all["settings"].contains(&digest(&project).unwrap()));
        for feature in &adjustment.features {
            let degrees = feature.quantity == Some(Quantity::Angle);
            let shown = |x: f64| if degrees { x.to_degrees() } else { x };
            if let (Some(value), Some(sigma)) = (feature.value.map(shown), feature.sigma.map(shown)) {
                let printed = plain(&[value, sigma].map(|x| fixed(x, decimals_for(sigma))).join(" "));
                assert!(all["features"].contains(&printed), "{} {printed}: {}", feature.id, all["features"]);
            }
        }
        let [system] = &adjustment.systems[..] else { panic!("{:?}", adjustment.systems) };
        for point in &system.points {
            let row = plain(&point.xyz.map(|x| fixed(x, decimals)).join(" "));
            assert!(all["features"].contains(&format!("{} {row}", point.id)), "{} {row}", point.id);
        }
        assert!(all["features"].contains("Base &lt;i&gt;") && adjustment.features[3].error.is_some());
        assert!(plain(&html).contains("First line\nsecond") || html.contains("First line\nsecond line"));
        assert!(html.contains("Panel &lt;b&gt;&quot;7&quot;"));
    }
}

#[test]
fn nothing_in_a_report_runs_or_is_fetched() {
    let mut project = project();
    for name in ["<script>alert(1)</script>", "\"><img src=http://x/ onerror=y>", "</style><b>"] {
        project.name = name.into();
        project.report.title = name.into();
        project.report.operator = name.into();
        project.photos[1].file = name.into();
        project.unit = name.into();
        let html = html(&project, &adjusted(&project));
        let body = html.split("</style>").nth(1).expect("a body");
        assert!(
            !html.contains("<script") && !body.contains("<img") && !body.contains("<b>\"") && !html.contains(" style=")
        );
        assert_eq!(html.matches("</style>").count(), 1);
        assert!(!html.contains("url(") && !html.contains("@import") && !html.contains("<link"));
    }
}

#[test]
fn sections_that_are_left_out_are_not_there() {
    let mut project = project();
    let adjustment = adjusted(&project);
    project.report.left_out = vec![Section::Points, Section::AllObservations];
    let all = sections(&html(&project, &adjustment));
    assert!(
        !all.contains_key("points") && !all.contains_key("all_observations") && all.len() == Section::ALL.len() - 2
    );
    // Of features nothing is said where there are none, and those that were made since are named.
    let mut without = project.clone();
    (without.features, without.systems) = (Vec::new(), Vec::new());
    assert!(!sections(&html(&without, &adjustment)).contains_key("features"));
    project.features.push(Feature { id: "later".into(), kind: project.features[0].kind.clone() });
    assert!(sections(&html(&project, &adjustment))["features"].contains("later was defined after this result"));
    project.features.pop();
    // Without lengths that are known and was not used there is nothing to say of them.
    project.distances.retain(|d| !d.check);
    let adjustment = adjusted(&project);
    assert!(!sections(&html(&project, &adjustment)).contains_key("lengths"));
}

#[test]
fn what_makes_no_sense_is_refused_by_name() {
    let project = project();
    let adjustment = adjusted(&project);
    let export =
        |project: &Project, adjustment| files::export("report", project, adjustment, false).expect_err("refused");
    assert_eq!(export(&project, None), Error::Empty { what: Lack::Adjustment });
    let mut other = project.clone();
    other.observations.remove(0);
    let reason = |error| match error {
        Error::Invalid { reason, at } => (reason, at.field.unwrap_or_default()),
        other => panic!("{other}"),
    };
    assert_eq!(reason(export(&other, Some(&adjustment))).0, ReportReason::OtherAdjustment.into());
    let mut wrong = project.clone();
    wrong.report.coverage_factor = f64::NAN;
    assert_eq!(reason(export(&wrong, Some(&adjustment))).1, "report.coverage_factor");
    let mut wrong = project.clone();
    wrong.report.logo = "data:image/svg+xml;base64,AAAA".into();
    assert_eq!(reason(export(&wrong, Some(&adjustment))).1, "report.logo");
    let mut right = project;
    right.report.logo = "data:image/png;base64,iVBORw0KGgo=".into();
    assert!(
        html(&right, &adjustment).contains("<img class=\"logo\" src=\"data:image/png;base64,iVBORw0KGgo=\" alt=\"\">")
    );
}

#[test]
fn the_digest_is_of_what_was_measured() {
    let project = project();
    let mut other = project.clone();
    other.report = ReportSettings::default();
    assert_eq!(digest(&project).unwrap(), digest(&other).unwrap());
    let exported = exchange::export("sightline", &other, None).unwrap();
    assert_eq!(digest(&project).unwrap(), sha256(&exported["project.json"]), "it can be taken from the exported file");
    other.observations[0].u += 1e-9;
    assert_ne!(digest(&project).unwrap(), digest(&other).unwrap());
    // The settings survive.
    let files = exchange::export("sightline", &project, None).unwrap();
    assert_eq!(exchange::import("sightline", &files).unwrap(), project);
}

#[test]
fn a_check_distance_takes_no_part_and_has_the_sigma_of_its_ends() {
    let project = project();
    let options = AdjustOptions { covariance_of: vec!["p12".into(), "p13".into()], ..AdjustOptions::default() };
    let with = adjust(&project, &options, &mut |_| true).unwrap();
    let mut without = project.clone();
    without.distances.retain(|d| !d.check);
    let without = adjust(&without, &options, &mut |_| true).unwrap();
    assert_eq!((&with.points, with.sigma0, with.redundancy), (&without.points, without.sigma0, without.redundancy));
    let [first, second] = &with.check_distances[..] else { panic!("two") };
    assert_eq!((first.from.as_str(), second.to.as_str()), ("p12", "p15"));
    let place = |id: &str| with.points.iter().find(|p| p.id == id).expect("adjusted").xyz;
    let (a, b) = (place("p12"), place("p13"));
    let d: [f64; 3] = std::array::from_fn(|k| b[k] - a[k]);
    let length = d[0].hypot(d[1]).hypot(d[2]);
    assert!((first.difference.unwrap() - (length - first.length)).abs() < 1e-12);
    let matrix = &with.covariance.as_ref().expect("asked for").matrix;
    let g: Vec<f64> = (0..6).map(|k| d[k % 3] / length * if k < 3 { -1.0 } else { 1.0 }).collect();
    let variance: f64 = (0..6).flat_map(|i| (0..6).map(move |j| (i, j))).map(|(i, j)| g[i] * matrix[i][j] * g[j]).sum();
    let sigma = first.sigma.expect("statistics");
    assert!((sigma / variance.sqrt() - 1.0).abs() < 1e-9, "{sigma} {}", variance.sqrt());
    // What is known beforehand lies where its sigma says.
    for check in &with.check_distances {
        assert!(check.difference.unwrap().abs() < 4.0 * check.sigma.unwrap(), "{check:?}");
    }
}

#[test]
fn a_report_of_300_points_and_40_photos_is_made_at_once() {
    let wanted = Wanted { photos: 40, points: 300, ..Wanted::default() };
    let mut project = noisy(&exact(&wanted, 3), &mut Noise::new(4, 0));
    project.report.left_out = Vec::new();
    let adjustment = adjust(&project, &AdjustOptions::default(), &mut |_| true).expect("solvable");
    let start = std::time::Instant::now();
    let html = html(&project, &adjustment);
    let took = start.elapsed().as_secs_f64();
    println!("report of 300 points and 40 photos: {took:.3} s, {} kB", html.len() / 1000);
    assert!(took < 3.0, "{took} s");
    // Of forty stations those are named whose names lie on no other.
    let plots = plots(&project, Some(&adjustment)).expect("plots");
    let above = plots.iter().find(|plot| plot.name == "network-above").expect("one");
    let value = |line: &str, name: &str| -> f64 {
        let rest = line.split_once(&format!(" {name}=\"")).expect("a place").1;
        rest.split_once('"').expect("its end").0.parse().expect("a number")
    };
    let names = above.svg.lines().filter(|line| line.contains("class=\"strong\"") && line.contains("\"middle\""));
    let places: Vec<[f64; 2]> = names.map(|line| [value(line, "x"), value(line, "y")]).collect();
    assert!(places.len() > 10, "{}", places.len());
    for (k, a) in places.iter().enumerate() {
        for b in &places[k + 1..] {
            assert!((a[0] - b[0]).abs() > 12.0 || (a[1] - b[1]).abs() > 12.0, "{a:?} {b:?}");
        }
    }
}

#[test]
fn every_plot_is_a_drawing_with_its_words() {
    let mut project = project();
    let adjustment = adjusted(&project);
    for language in [ReportLanguage::English, ReportLanguage::Korean] {
        project.report.language = Some(language);
        let plots = plots(&project, Some(&adjustment)).expect("plots");
        let named = |name: &str| plots.iter().any(|plot| plot.name.starts_with(name));
        let names = [
            "radial-",
            "decentring-",
            "significance-",
            "network-above",
            "network-front",
            "rays",
            "angles",
            "sigmas",
            "histogram",
            "normal-plot",
            "convergence",
            "residuals-of-",
            "residuals-radius",
            "redundancy-",
            "residuals-f0",
        ];
        for name in names {
            assert!(named(name), "{name}");
        }
        let files = files::export("plots", &project, Some(&adjustment), false).expect("files");
        assert_eq!(files.len(), plots.len(), "every plot has a name of its own");
        for plot in &plots {
            assert!(!plot.title.is_empty() && !plot.sentence.is_empty(), "{}", plot.name);
            assert!(!plot.svg.contains("NaN") && !plot.svg.contains("inf\""), "{}", plot.svg);
            assert!(!plot.svg.contains(" style=") && plot.svg.contains("<title>") && plot.svg.contains("<desc>"));
            let text = String::from_utf8(files[&format!("{}.svg", plot.name)].clone()).expect("UTF-8");
            let open = text.matches('<').count() - text.matches("</").count() - text.matches("/>").count();
            assert_eq!(open, text.matches("</").count(), "{}: every element is closed", plot.name);
            assert!(text.starts_with("<svg class=") && text.contains("xmlns=") && text.contains("<style>"));
        }
    }
}

#[test]
fn two_adjustments_are_compared_point_by_point() {
    let project = project();
    let adjustment = adjusted(&project);
    let beside = |before: &Adjustment| {
        let found = compare((&project, before), (&project, &adjustment));
        comparison(&project, Some(&adjustment), &found).expect("a result")
    };
    let same = beside(&adjustment).expect("a plot");
    assert!(same.sentence.contains("Beyond 3.29 standard errors: 0."), "{}", same.sentence);
    let mut moved = adjustment.clone();
    let last = moved.points.last_mut().expect("points");
    last.xyz[2] += 5.0;
    let id = last.id.clone();
    let told = beside(&moved).expect("a plot").sentence;
    let said = told.contains("Beyond 3.29 standard errors: 1.") && told.contains("5.0");
    assert!(told.contains(&format!("point {id}")) && said, "{told}");
    moved.points.clear();
    assert_eq!(beside(&moved), None);
}

#[test]
fn the_band_of_the_distortion_is_the_spread_of_many_adjustments() {
    // Δr at a radius from the covariance of K1, K2, against the scatter of 60 networks that differ in their noise alone.
    let wanted = Wanted {
        photos: 8,
        points: 40,
        cameras: vec![brown(&[Parameter::C, Parameter::X0, Parameter::Y0, Parameter::K1, Parameter::K2])],
        ..Wanted::default()
    };
    let truth = exact(&wanted, 21);
    let at = |camera: &sightline::project::Camera, r: f64| {
        let k = |p| camera.interior.get(p).unwrap_or(0.0);
        k(Parameter::K1) * r.powi(3) + k(Parameter::K2) * r.powi(5)
    };
    let (radius, mut values, mut sigmas) = (8.0, Vec::new(), Vec::new());
    for seed in 0..60 {
        let project = noisy(&truth, &mut Noise::new(seed, 1));
        let adjustment = adjust(&project, &AdjustOptions::default(), &mut |_| true).expect("solvable");
        let camera = &adjustment.cameras[0];
        values.push(at(&camera.camera, radius));
        let sigma = sightline_report::plots::radial_sigma(camera, radius).expect("statistics");
        // The scatter is that of the assumed noise: free of this network's own σ0.
        sigmas.push(sigma / adjustment.sigma0.expect("redundant"));
    }
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let scatter = (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (values.len() - 1) as f64).sqrt();
    let predicted = sigmas.iter().sum::<f64>() / sigmas.len() as f64;
    // A standard deviation from 60 values has a standard error of 9 %.
    assert!((scatter / predicted - 1.0).abs() < 0.27, "{scatter} {predicted}");
}

/// A document that an earlier version corrected by lateral colour: the report says that it no longer is, and names no other program.
#[test]
fn what_an_earlier_document_had_is_named() {
    let mut project = project();
    let adjustment = adjusted(&project);
    let earlier =
        |project: &Project| html(project, &adjustment).contains("corrected image coordinates for lateral colour");
    assert!(!earlier(&project));
    RemovedFields { cameras: 1, photos: 8, reported: 1 }.note_in(&mut project);
    assert!(earlier(&project) && !html(&project, &adjustment).contains("Files of another program"));
}

/// Of a network with very many points the report lists those with a role and the least certain ones, draws some, and says so.
#[test]
fn very_many_points_are_listed_and_drawn_in_part() {
    let mut project = project();
    let mut adjustment = adjusted(&project);
    let few = html(&project, &adjustment);
    assert!(!few.contains("points are listed") && !few.contains("is drawn."), "everything is there");
    let (point, found) = (project.points.last().cloned(), adjustment.points.last().cloned());
    let (point, found) = (point.expect("points"), found.expect("points"));
    for k in 0..6000 {
        let mut more = found.clone();
        more.id = format!("m{k}");
        more.sigma = Some([1e-4 * f64::from(6000 - k), 1e-4, 1e-4]);
        project.points.push(sightline::project::Point { id: more.id.clone(), role: Role::Tie, ..point.clone() });
        adjustment.points.push(more);
    }
    let many = html(&project, &adjustment);
    let all = count(adjustment.points.len());
    assert!(many.contains(&format!("{} of {all} points are listed", count(5000))), "{all}");
    let row = |id: &str| many.contains(&format!(">{id}</td>"));
    let given: Vec<&str> = project.points.iter().filter(|p| p.role != Role::Tie).map(|p| p.id.as_str()).collect();
    assert!(!given.is_empty() && given.iter().all(|id| row(id)), "points with a role");
    assert!(row("m0") && row("m4000") && !row("m5999"), "the least certain tie points");

    assert!(many.contains("One in 3 is drawn.") && many.len() < 4 * few.len() + 2_000_000);
}
