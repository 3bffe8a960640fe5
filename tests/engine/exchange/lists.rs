//! Lists of points of instruments and programs, drawn at random and written as those write them; and what is written for other programs.

use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Adjustment};
use sightline::noise::Noise;
use sightline::project::{DrawnLine, Layer, Project};
use sightline::units::Unit;
use sightline_exchange::control_csv::{Assumption, Basis, TableChoices};
use sightline_exchange::encoding::{Encoding, list, to_cp949};
use sightline_exchange::lists::{PointList, read};
use sightline_exchange::{Files, export, import, import_with};

use crate::support::data;
use crate::support::networks::{Uniform, Wanted, exact, noisy};

struct Truth {
    id: String,
    /// East, north, up in whole hundredths of a millimetre.
    places: [i64; 3],
    code: &'static str,
}

fn points(random: &mut Uniform, letters: &str) -> Vec<Truth> {
    let letters: Vec<char> = letters.chars().collect();
    let mut pick = |n: usize| (random.between(0.0, n as f64) as usize).min(n - 1);
    (0..1 + pick(6))
        .map(|k| Truth {
            id: format!("{}{}{k}", letters[pick(letters.len())], letters[pick(letters.len())]),
            places: std::array::from_fn(|_| pick(60_000_000) as i64 * 1000 - 2_000_000_000 + pick(1000) as i64),
            code: ["", "TGT", "NAIL"][pick(3)],
        })
        .collect()
}

fn decimal(places: i64, decimals: usize) -> (String, f64) {
    let value = (places / 10_i64.pow(5 - decimals as u32)) as f64 / 10_f64.powi(decimals as i32);
    let text = format!("{value:.decimals$}");
    let value = text.parse().unwrap();
    (text, value)
}

/// Name, coordinates and code of a point.
type Written = (String, [f64; 3], Option<String>);

/// A list in a format, and the coordinates that were written.
fn written(kind: usize, random: &mut Uniform) -> (String, Vec<Written>, Option<Unit>) {
    let all = points(random, if kind < 2 { "ABCXYZ" } else { "AZ가é<&'" });
    let coarse = random.between(0.0, 1.0) < 0.5;
    let decimals = if kind == 0 && !coarse { 5 } else { 3 };
    let truth = all.iter().map(|p| {
        let code = Some(p.code.to_owned()).filter(|code| !code.is_empty());
        (p.id.clone(), p.places.map(|v| decimal(v, decimals).1), code)
    });
    let words = |p: &Truth| p.places.map(|v| decimal(v, decimals).0);
    let escaped = |text: &str| text.replace('&', "&amp;").replace('<', "&lt;").replace('\'', "&#39;");
    let (text, unit) = match kind {
        0 => {
            let word = |index: &str, value: i64| {
                let value = value / 10_i64.pow(5 - decimals as u32);
                let sign = if value < 0 { '-' } else { '+' };
                format!("{index}..0{}{sign}{:0>16}", if decimals == 5 { 8 } else { 0 }, value.abs())
            };
            let line = |(k, p): (usize, &Truth)| {
                let [e, n, h] = p.places;
                let code = if p.code.is_empty() { String::new() } else { format!(" 71....+{:0>16}", p.code) };
                format!(
                    "*11{:04}+{:0>16} {} {} {}{code} \r\n",
                    k + 1,
                    p.id,
                    word("81", e),
                    word("82", n),
                    word("83", h)
                )
            };
            (all.iter().enumerate().map(line).collect::<String>(), Some(Unit::Metre))
        }
        1 => {
            let line = |p: &Truth| {
                let [e, n, h] = words(p);
                format!("08TP{:>16}{n:<16}{e:<16}{h:<16}{:<16}\n", p.id, p.code)
            };
            let head = "00NMSDR33 V04-04.02     00-000-00 00:00 211111\n10NMJOB             121111\n";
            (head.to_owned() + &all.iter().map(line).collect::<String>(), Some(Unit::Metre))
        }
        2 => {
            let line = |p: &Truth| {
                let [e, n, h] = words(p);
                format!(
                    "<Point><Name>{}</Name><Code>{}</Code><Grid><North>{n}</North><East>{e}</East><Elevation>{h}</Elevation></Grid></Point>\n",
                    escaped(&p.id),
                    p.code
                )
            };
            let body = all.iter().map(line).collect::<String>();
            (
                format!("<?xml version=\"1.0\"?>\n<JOBFile>\n<Reductions>{body}</Reductions></JOBFile>"),
                Some(Unit::Metre),
            )
        }
        _ => {
            let line = |p: &Truth| {
                let [e, n, h] = words(p);
                format!("<CgPoint name='{}' code='{}'>{n} {e}\n {h}</CgPoint>\n", escaped(&p.id), p.code)
            };
            let body = all.iter().map(line).collect::<String>();
            let units = "<Units><Imperial linearUnit=\"foot\"/></Units>";
            (format!("<?xml version='1.0'?><LandXML>{units}\n<CgPoints>{body}</CgPoints></LandXML>"), Some(Unit::Foot))
        }
    };
    (text, truth.collect(), unit)
}

#[test]
fn lists_of_instruments_are_read_to_the_last_digit() {
    let mut random = Uniform(52);
    for round in 0..2000 {
        let (text, truth, unit) = written(round % 4, &mut random);
        let found = read(text.as_bytes(), &TableChoices::default()).unwrap_or_else(|error| panic!("{error}\n{text}"));
        assert!(found.rejected.is_empty() && found.undecided.is_empty(), "{found:?}\n{text}");
        assert_eq!(found.unit, unit);
        let all: Vec<_> =
            found.points.iter().map(|p| (p.point.id.clone(), p.point.xyz.unwrap(), p.label.clone())).collect();
        assert_eq!(all, truth, "{text}");
    }
}

fn case(name: &str) -> Option<PointList> {
    let bytes = data::data(&format!("cases/{name}"))?;
    Some(read(&bytes, &TableChoices::default()).unwrap_or_else(|error| panic!("{name}: {error}")))
}

#[test]
fn the_cases_by_their_bytes() {
    let Some(commas) = case("decimal_commas.csv") else { return };
    assert_eq!((commas.points.len(), commas.rejected.len()), (0, 3));
    assert_eq!(commas.rejected[1].text, "P2,4,567,5,678,6,789");
    let metashape = case("metashape_reference.csv").unwrap();
    assert_eq!((metashape.points.len(), metashape.points[0].point.sigma), (2, None));
    assert_eq!(metashape.heading[0], "Label");
    let pnezd = case("pnezd.csv").unwrap();
    assert_eq!(pnezd.points[3].label.as_deref(), Some("NAIL"));
    assert!(matches!(pnezd.undecided[..], [Assumption::AxisOrder { by: Basis::Undecided, .. }]));
    let korean = case("korean_head.csv").unwrap();
    assert_eq!(korean.points[1].point.xyz, Some([205_001.123, 545_001.456, 31.323]));
    assert!(korean.assumptions.contains(&Assumption::Encoding { encoding: Encoding::Cp949, by: Basis::Content }));
}

#[test]
fn projects_take_every_list() {
    let bytes = b"<LandXML><Units><Metric linearUnit=\"meter\"/></Units><CgPoints><CgPoint name=\"a\">2 1 3</CgPoint></CgPoints></LandXML>";
    let files = Files::from([("a.xml".to_owned(), bytes.to_vec())]);
    let imported = import_with("control-csv", &files, TableChoices::default()).unwrap();
    assert_eq!((imported.project.unit.as_str(), imported.project.points[0].xyz), ("m", Some([1.0, 2.0, 3.0])));
}

fn result() -> (Project, Adjustment) {
    let mut project = noisy(&exact(&Wanted::default(), 3), &mut Noise::new(3, 0));
    project.name = "홀 4".into();
    project.points[3].id = "점 <7>".into();
    for o in project.observations.iter_mut().filter(|o| o.point == "p3") {
        o.point = "점 <7>".into();
    }
    let line = |from: &str, to: &str, layer: &str| DrawnLine { from: from.into(), to: to.into(), layer: layer.into() };
    project.lines =
        vec![line("p0", "p1", "모서리"), line("p1", "p2", "0"), line("p0", "p2", "a/b"), line("p2", "p1", "A_B")];
    project.layers = vec![Layer { id: "모서리".into(), colour: [255, 0, 0] }];
    let adjustment = adjust(&project, &AdjustOptions::default(), &mut |_| true).expect("solvable");
    (project, adjustment)
}

/// Where the drawing, the points and the calibration go for readers of other programs, if they are asked for.
fn kept(files: &Files, prefix: &str) {
    if let Ok(folder) = std::env::var("SIGHTLINE_OUT") {
        for (name, bytes) in files {
            std::fs::write(format!("{folder}/{prefix}-{name}"), bytes).expect("written");
        }
    }
}

#[test]
fn a_drawing_of_release_2010_is_whole() {
    let (project, adjustment) = result();
    let files = export("dxf-2010", &project, Some(&adjustment)).expect("written");
    kept(&files, "2010");
    let text = String::from_utf8(files["drawing.dxf"].clone()).expect("UTF-8");
    let lines: Vec<&str> = text.lines().collect();
    let pairs: Vec<(i32, &str)> = lines.chunks(2).map(|pair| (pair[0].parse().expect("a code"), pair[1])).collect();
    let value = |name: &str| pairs.iter().position(|pair| *pair == (9, name)).map(|k| pairs[k + 1].1);
    assert_eq!((value("$ACADVER"), value("$INSUNITS")), (Some("AC1024"), Some("4")));
    // Handles are unique and below the seed; every reference is to one of them.
    let mut handles: Vec<u32> = Vec::new();
    for (k, (code, text)) in pairs.iter().enumerate() {
        let seed = k > 0 && pairs[k - 1] == (9, "$HANDSEED");
        if (*code == 5 && !seed) || *code == 105 {
            handles.push(u32::from_str_radix(text, 16).expect("a handle"));
        }
    }
    let count = handles.len();
    handles.sort_unstable();
    handles.dedup();
    assert_eq!(handles.len(), count);
    assert!(u32::from_str_radix(value("$HANDSEED").unwrap(), 16).unwrap() > *handles.last().unwrap());
    for (_, text) in pairs.iter().filter(|(code, text)| matches!(code, 330 | 340 | 350 | 390) && *text != "0") {
        assert!(handles.binary_search(&u32::from_str_radix(text, 16).expect("a handle")).is_ok(), "{text}");
    }
    let named = |kind: &str| pairs.iter().filter(|pair| **pair == (0, kind)).count();
    assert_eq!(named("POINT"), project.points.len());
    for layer in ["모서리", "0_2", "a_b", "A_B_2"] {
        assert!(pairs.contains(&(2, layer)) && pairs.contains(&(8, layer)), "{layer}");
    }
    assert!(pairs.contains(&(1, "점 <7>")));
}

#[test]
fn points_of_land_xml_come_back() {
    let (project, adjustment) = result();
    let files = export("landxml", &project, Some(&adjustment)).expect("written");
    kept(&files, "land");
    let again = import("control-csv", &files).expect("its own");
    assert_eq!(again.unit, project.unit);
    for point in &again.points {
        let known = adjustment.points.iter().find(|p| p.id == point.id).expect("of the project");
        let (xyz, sigma) = (point.xyz.unwrap(), known.sigma.unwrap());
        assert!((0..3).all(|k| (xyz[k] - known.xyz[k]).abs() <= 0.05 * sigma[k] + 1e-12), "{}", point.id);
    }
    assert_eq!(again.points.len(), adjustment.points.len());
    for unit in Unit::ALL {
        let own = Project { unit: unit.symbol().into(), ..project.clone() };
        let back = import("control-csv", &export("landxml", &own, None).expect("written")).expect("its own");
        let factor = unit.factor(Unit::named(&back.unit).expect("a unit"));
        let given = own.points.iter().find(|point| point.xyz.is_some());
        if let (Some(given), Some(read)) = (given, back.points.first()) {
            let [a, b] = [given.xyz.unwrap()[0] * factor, read.xyz.unwrap()[0]];
            assert!((a - b).abs() < 1e-9 * a.abs().max(1.0), "{unit:?} {a} {b}");
        }
    }
    assert_eq!(export("landxml", &Project { unit: "ell".into(), ..project }, None).unwrap_err().code(), "invalid");
}

#[test]
fn spreadsheets_have_the_digits_of_the_standard_errors() {
    let (mut project, adjustment) = result();
    let files = export("spreadsheet", &project, Some(&adjustment)).expect("written");
    let text = String::from_utf8(files["points.csv"].clone()).expect("UTF-8");
    let text = text.strip_prefix('\u{feff}').expect("a mark");
    let mut checked = 0;
    for line in text.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let known = adjustment.points.iter().find(|p| p.id == fields[0]).expect("of the project");
        for k in 0..3 {
            let (written, sigma) = (fields[2 + k], fields[5 + k]);
            assert!(sigma.replace('.', "").trim_matches('0').len() <= 2, "{line}");
            let (a, b) = (written.parse::<f64>().unwrap(), sigma.parse::<f64>().unwrap());
            assert!((a - known.xyz[k]).abs() <= 0.06 * b && (b / known.sigma.unwrap()[k] - 1.0).abs() < 0.06, "{line}");
            checked += 1;
        }
    }
    assert!(checked > 20);
    assert_eq!(
        files.keys().collect::<Vec<_>>(),
        export("csv", &project, Some(&adjustment)).unwrap().keys().collect::<Vec<_>>()
    );
    // A Korean spreadsheet of old.
    let korean = export("spreadsheet-cp949", &project, Some(&adjustment)).expect("written");
    let (read, encoding, _) = list(&korean["points.csv"], None).expect("a text");
    assert_eq!((encoding, read.as_str()), (Encoding::Cp949, text));
    project.points[0].id = "é😀".into();
    assert!(export("spreadsheet-cp949", &project, None).unwrap_err().to_string().contains("é😀"));
    assert!(to_cp949("㎜ 벽").is_ok());
}

#[test]
fn a_calibration_is_one_record() {
    let (project, adjustment) = result();
    let files = export("calibration", &project, Some(&adjustment)).expect("written");
    kept(&files, "record");
    let record: serde_json::Value = serde_json::from_slice(&files["calibration.json"]).expect("JSON");
    let (camera, known) = (&record["cameras"][0], &adjustment.cameras[0]);
    let sigmas = camera["parameters"].as_array().unwrap().iter().filter(|p| p["sigma"].is_number()).count();
    assert_eq!(sigmas, known.sigma.len());
    assert_eq!(camera["correlation"]["names"].as_array().map_or(0, Vec::len), known.correlation.names.len());
    let table = String::from_utf8(files["calibration.csv"].clone()).expect("UTF-8");
    let widths: Vec<usize> =
        table.lines().filter(|line| !line.is_empty()).map(|line| line.split(',').count()).collect();
    assert_eq!(widths.iter().max(), Some(&(6 + known.correlation.names.len())));
    assert_eq!(export("calibration", &Project::default(), None).unwrap_err().code(), "empty");
}
