//! Control tables of all habits, drawn at random: a value is read right, or it is refused or asked; never wrong.

use sightline::units::Unit;
use sightline_exchange::control_csv::{
    Assumption, Axes, Basis, ControlTable, Decimal, Sign, TableChoices, parse, parse_with, sign_of,
};
use sightline_exchange::{Files, encoding, import_with};

use crate::support::data;
use crate::support::networks::Uniform;

/// How a table is written.
#[derive(Clone, Debug)]
struct Habit {
    separator: char,
    decimal_comma: bool,
    /// Thousands separator, if any.
    thousands: Option<char>,
    decimals: usize,
    heading: Heading,
    unit: Option<Unit>,
    sigmas: usize,
    label: bool,
    description: bool,
    quoted: bool,
    north_first: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Heading {
    None,
    Letters,
    Directions,
    Surveyors,
    Korean,
    KoreanDirections,
    Metashape,
}

struct Truth {
    id: String,
    /// East, north, up.
    xyz: [f64; 3],
    sigma: [f64; 3],
}

fn pick<T: Clone>(random: &mut Uniform, all: &[T]) -> T {
    all[(random.between(0.0, all.len() as f64) as usize).min(all.len() - 1)].clone()
}

fn habit(random: &mut Uniform) -> Habit {
    let decimal_comma = random.between(0.0, 1.0) < 0.5;
    let yes = |random: &mut Uniform| random.between(0.0, 1.0) < 0.3;
    let thousands = match (yes(random), decimal_comma) {
        (false, _) => None,
        (true, true) => Some(pick(random, &['.', ' '])),
        (true, false) => Some(pick(random, &[',', ' '])),
    };
    let heading = pick(
        random,
        &[
            Heading::None,
            Heading::None,
            Heading::Letters,
            Heading::Directions,
            Heading::Surveyors,
            Heading::Korean,
            Heading::KoreanDirections,
            Heading::Metashape,
        ],
    );
    let decimals = pick(random, &[0, 1, 2, 3, 3, 4]);
    // A point is a decimal point where nothing else is in the text: a convention, not a guess between two.
    let thousands = thousands.filter(|mark| *mark != '.' || decimals > 0);
    Habit {
        separator: pick(random, &[',', ';', '\t', ' ']),
        decimal_comma,
        thousands,
        decimals,
        heading,
        unit: (heading != Heading::None && yes(random)).then(|| pick(random, &Unit::ALL)),
        sigmas: pick(random, &[0, 0, 1, 3]),
        label: yes(random),
        description: yes(random),
        quoted: yes(random),
        north_first: random.between(0.0, 1.0) < 0.5,
    }
}

fn number(value: f64, habit: &Habit) -> String {
    let text = format!("{:.*}", habit.decimals, value.abs());
    let (whole, rest) = text.split_once('.').unwrap_or((&text, ""));
    let mut grouped = String::new();
    for (k, digit) in whole.chars().enumerate() {
        if let Some(mark) = habit.thousands.filter(|_| k > 0 && (whole.len() - k).is_multiple_of(3)) {
            grouped.push(mark);
        }
        grouped.push(digit);
    }
    if !rest.is_empty() {
        grouped.push(if habit.decimal_comma { ',' } else { '.' });
        grouped += rest;
    }
    if value < 0.0 { format!("-{grouped}") } else { grouped }
}

/// Meaning of the written number.
fn rounded(value: f64, habit: &Habit) -> f64 {
    format!("{:.*}", habit.decimals, value).parse().unwrap()
}

fn written(habit: &Habit, points: &[Truth]) -> String {
    let unit = habit.unit.map(|unit| format!(" [{}]", unit.symbol())).unwrap_or_default();
    let [first, second, height] = match (habit.heading, habit.north_first) {
        (Heading::None, _) => ["", "", ""],
        (Heading::Letters, true) => ["Y", "X", "Z"],
        (Heading::Letters, false) => ["X", "Y", "Z"],
        (Heading::Directions, true) => ["X(N)", "Y(E)", "Z(H)"],
        (Heading::Directions, false) => ["Y(E)", "X(N)", "H"],
        (Heading::Surveyors, true) => ["Northing", "Easting", "Elevation"],
        (Heading::Surveyors, false) => ["E", "N", "Height"],
        (Heading::Korean, true) => ["Y좌표", "X좌표", "표고"],
        (Heading::Korean, false) => ["X좌표", "Y좌표", "표고"],
        (Heading::KoreanDirections, true) => ["종좌표", "횡좌표", "높이"],
        (Heading::KoreanDirections, false) => ["횡", "종", "지반고"],
        (Heading::Metashape, true) => ["Y/Northing", "X/Easting", "Z/Altitude"],
        (Heading::Metashape, false) => ["X/Easting", "Y/Northing", "Z/Altitude"],
    };
    let mut names = vec![pick(&mut Uniform(points.len() as u64), &["id", "점번호", "Label"]).to_owned()];
    if habit.label {
        names.push("name".into());
    }
    names.extend([first, second, height].map(|name| format!("{name}{unit}")));
    let exchanged = habit.heading == Heading::Directions;
    match habit.sigmas {
        1 => names.push(format!("sigma{unit}")),
        3 => {
            // Named as the columns of their coordinates are.
            let letters = if habit.north_first != exchanged { ["sY", "sX", "sZ"] } else { ["sX", "sY", "sZ"] };
            names.extend(letters.map(|name| format!("{name}{unit}")));
        }
        _ => {}
    }
    if habit.description {
        names.push("description".into());
    }
    let quote = |text: String| if habit.quoted && habit.separator != ' ' { format!("\"{text}\"") } else { text };
    let row =
        |fields: Vec<String>| fields.into_iter().map(quote).collect::<Vec<_>>().join(&habit.separator.to_string());
    let mut lines = Vec::new();
    if habit.heading != Heading::None {
        let names = if habit.separator == ' ' { names.iter().map(|n| n.replace(' ', "")).collect() } else { names };
        let comment = habit.heading == Heading::Metashape;
        lines.push(format!("{}{}", if comment { "#" } else { "" }, row(names)));
    }
    for (k, point) in points.iter().enumerate() {
        let order = if habit.north_first { [1, 0, 2] } else { [0, 1, 2] };
        let mut fields = vec![point.id.clone()];
        if habit.label {
            fields.push(format!("CP{k}"));
        }
        fields.extend(order.map(|axis| number(point.xyz[axis], habit)));
        match habit.sigmas {
            1 => fields.push(number(point.sigma[0], habit)),
            3 => fields.extend(order.map(|axis| number(point.sigma[axis], habit))),
            _ => {}
        }
        if habit.description {
            fields.push("TGT".into());
        }
        lines.push(row(fields));
    }
    lines.join("\n") + "\n"
}

fn points(random: &mut Uniform, habit: &Habit) -> Vec<Truth> {
    let scale = pick(random, &[3.0, 50.0, 900.0, 20_000.0, 500_000.0]);
    let near = |random: &mut Uniform| random.between(-0.3, 1.0) * scale;
    (0..3 + pick(random, &[0, 1, 4]))
        .map(|k| Truth {
            id: format!("P{k}"),
            xyz: [near(random), near(random), near(random) / 3.0],
            sigma: if habit.sigmas == 1 {
                [random.between(0.0, 2.0); 3]
            } else {
                [random.between(0.0, 2.0), random.between(0.0, 2.0), random.between(0.0, 2.0)]
            },
        })
        .collect()
}

/// How a habit's table compares: rows read right, rows refused.
fn compared(habit: &Habit, points: &[Truth], table: &ControlTable, text: &str) -> [usize; 2] {
    let mut counts = [0; 2];
    // Without a heading the order is the convention or asked; with one it is the heading's.
    let axes = table.assumptions.iter().find_map(|a| match a {
        Assumption::AxisOrder { by, .. } => Some(*by),
        _ => None,
    });
    let told = matches!(axes, Some(Basis::Undecided | Basis::Convention)) && habit.heading == Heading::None;
    for row in &table.rows {
        let Ok(row) = row else {
            counts[1] += 1;
            continue;
        };
        let truth = points.iter().find(|point| point.id == row.point.id).unwrap_or_else(|| panic!("{text}"));
        let order = if told && habit.north_first { [1, 0, 2] } else { [0, 1, 2] };
        let xyz = row.point.xyz.unwrap();
        for axis in 0..3 {
            let expected = rounded(truth.xyz[order[axis]], habit);
            assert!((xyz[axis] - expected).abs() <= 1e-12 * expected.abs(), "{xyz:?} {expected} {habit:?}\n{text}");
            if habit.sigmas > 0 {
                let sigma = row.point.sigma.unwrap_or_else(|| panic!("{habit:?}\n{text}"))[axis];
                assert_eq!(sigma, Some(rounded(truth.sigma[order[axis]], habit)), "{habit:?}\n{text}");
            } else {
                assert_eq!(row.point.sigma, None, "{habit:?}\n{text}");
            }
        }
        assert_eq!(table.unit, habit.unit, "{habit:?}\n{text}");
        counts[0] += 1;
    }
    counts
}

#[test]
fn a_value_is_read_right_or_refused() {
    let mut random = Uniform(4711);
    let [mut read, mut refused] = [0, 0];
    for _ in 0..20_000 {
        let habit = habit(&mut random);
        let points = points(&mut random, &habit);
        let text = written(&habit, &points);
        let table = parse(&text);
        let [right, not] = compared(&habit, &points, &table, &text);
        [read, refused] = [read + right, refused + not];
        // What leaves nothing open is read.
        let clear = habit.thousands.is_none() && !habit.decimal_comma && habit.decimals > 0;
        if clear && not > 0 {
            let error = table.rows.iter().find_map(|row| row.as_ref().err()).unwrap();
            panic!("{error} {habit:?}\n{text}");
        }
        // Every row that is refused says why, and a right choice of the decimal sign opens what separators leave clear.
        let separate = matches!(habit.separator, ';' | '\t') && habit.thousands.is_none();
        if separate {
            let decimal = Some(if habit.decimal_comma { Decimal::Comma } else { Decimal::Point });
            let chosen = parse_with(&text, TableChoices { decimal, ..TableChoices::default() });
            let [_, not] = compared(&habit, &points, &chosen, &text);
            assert_eq!(not, 0, "{habit:?}\n{text}");
        }
    }
    assert!(read > 40_000 && refused > 5_000, "{read} {refused}");
}

#[test]
fn decimal_comma_tables_of_spreadsheets_are_read_or_asked() {
    let mut random = Uniform(5);
    for _ in 0..2000 {
        let habit = Habit { separator: ';', decimal_comma: true, thousands: None, ..habit(&mut random) };
        let points = points(&mut random, &habit);
        let text = written(&habit, &points);
        let table = parse(&text);
        let [_, not] = compared(&habit, &points, &table, &text);
        let asked =
            |a: &Assumption| matches!(a, Assumption::DecimalSign { by: Basis::Undecided, example: Some(_), .. });
        assert_eq!(not > 0, table.undecided().any(asked), "{habit:?}\n{text}");
    }
}

#[test]
fn headings_decide_the_axes_and_the_units() {
    for (heading, exchanged) in [
        ("id,X,Y,Z", false),
        ("id,X(N),Y(E),Z(H)", true),
        ("점명,X(N),Y(E),Z(H)", true),
        ("점번호,종,횡,표고", true),
        ("점번호,횡좌표(m),종좌표(m),표고(m)", false),
        ("Point,Northing,Easting,Elevation", true),
        ("Punkt;Rechtswert;Hochwert;Höhe", false),
        ("Name,Hochwert,Rechtswert,Höhe", true),
        ("id,N [m],E [m],H [m]", true),
        ("id,X (North),Y,Z", true),
        ("id,X,Y (North),Z", false),
        ("#Label,Y/Northing,X/Easting,Z/Altitude", true),
    ] {
        let separator = if heading.contains(';') { ';' } else { ',' };
        let row = ["1", "10.5", "20.5", "30.5"].join(&separator.to_string());
        let table = parse(&format!("{heading}\n{row}\n"));
        let expected = if exchanged { [20.5, 10.5, 30.5] } else { [10.5, 20.5, 30.5] };
        let xyz = table.rows[0].as_ref().unwrap_or_else(|error| panic!("{heading}: {error}")).point.xyz;
        assert_eq!(xyz, Some(expected), "{heading}");
        assert!(table.has_heading() && table.undecided().next().is_none(), "{heading}");
    }
    // Standard errors follow the letters of their coordinates.
    let table = parse("id,X(N),Y(E),Z,sX,sY,sZ\n1,10.5,20.5,30.5,0.1,0.2,0.3\n");
    assert_eq!(table.rows[0].as_ref().unwrap().point.sigma, Some([Some(0.2), Some(0.1), Some(0.3)]));
    for (heading, unit, xyz, sigma) in [
        ("id,X [m],Y [m],Z [m],sX [mm],sY [mm],sZ [mm]", Some(Unit::Metre), [1.5, 2.5, 3.5], 0.25e-3),
        ("id,X_mm,Y_mm,Z_mm,sX,sY,sZ", Some(Unit::Millimetre), [1.5, 2.5, 3.5], 0.25),
        ("id,X (m),Y (cm),Z (미터),sX (m),sY (m),sZ (m)", Some(Unit::Metre), [1.5, 0.025, 3.5], 0.25),
        ("id,X [ft],Y [ft],Z [ft],sX [in],sY [in],sZ [in]", Some(Unit::Foot), [1.5, 2.5, 3.5], 0.25 / 12.0),
        ("id,X,Y,Z,sX,sY,sZ", None, [1.5, 2.5, 3.5], 0.25),
    ] {
        let table = parse(&format!("{heading}\n1,1.5,2.5,3.5,0.25,0.25,0.25\n"));
        let point = &table.rows[0].as_ref().unwrap_or_else(|error| panic!("{heading}: {error}")).point;
        assert_eq!((table.unit, point.xyz), (unit, Some(xyz)), "{heading}");
        assert_eq!(point.sigma, Some([Some(sigma); 3]), "{heading}");
    }
    for bad in [
        "id,X [banana],Y,Z",
        "id,X,Y",
        "id,X,X,Y,Z",
        "id,N,N,H",
        "id,X (E),Y (E),Z",
        "id,X,Y,Z,sX [mm],sY [mm],sZ [mm]",
        "X,Y,Z",
    ] {
        let columns = bad.split(',').count();
        let row: Vec<String> = (0..columns).map(|k| format!("{}.5", k + 1)).collect();
        let table = parse(&format!("{bad}\n{}\n", row.join(",")));
        assert!(table.rows.iter().all(Result::is_err) && table.is_open(), "{bad}: {table:?}");
    }
    // A chosen unit settles what the standard errors leave open.
    let metres = TableChoices { unit: Some(Unit::Metre), ..TableChoices::default() };
    let table = parse_with("id,X,Y,Z,sX [mm],sY [mm],sZ [mm]\n1,1.5,2.5,3.5,2,2,2\n", metres);
    assert_eq!(table.rows[0].as_ref().unwrap().point.sigma, Some([Some(0.002); 3]));
}

#[test]
fn a_number_decides_only_what_it_shows() {
    for (word, sign) in [
        ("1,234", Sign::Either),
        ("-12,345", Sign::Either),
        ("123,456", Sign::Either),
        ("0,123", Sign::Comma),
        ("1234,567", Sign::Comma),
        ("1,23", Sign::Comma),
        ("1,2345", Sign::Comma),
        (",5", Sign::Comma),
        ("1.234", Sign::Point),
        ("1,234,567", Sign::None),
        ("1,234.5", Sign::None),
        ("1234", Sign::None),
        ("TGT", Sign::None),
    ] {
        assert_eq!(sign_of(word), sign, "{word}");
    }
}

fn case(name: &str) -> Option<String> {
    let bytes = data::data(&format!("cases/{name}"))?;
    Some(encoding::text(&bytes).unwrap_or_else(|error| panic!("{name}: {error}")))
}

#[test]
fn the_lists_of_the_cases() {
    let Some(text) = case("decimal_commas.csv") else { return };
    let table = parse(&text);
    assert!(table.rows.len() == 3 && table.rows.iter().all(Result::is_err) && table.is_open());
    let reason = table.rows[0].as_ref().unwrap_err().to_string();
    assert!(reason.contains("may separate decimals"), "{reason}");

    let table = parse(&case("metashape_reference.csv").unwrap());
    let found: Vec<_> = table.rows.iter().map(|row| row.as_ref().unwrap().point.clone()).collect();
    assert_eq!((found[0].id.as_str(), found[0].xyz, found[0].sigma), ("t1", Some([0.0; 3]), None));
    assert_eq!((found[1].xyz, found[1].sigma), (Some([0.5, 0.0, 0.0]), None));
    let ignored = |a: &Assumption| matches!(a, Assumption::Ignored { columns } if columns.len() == 7);
    assert!(table.has_heading() && table.assumptions.iter().any(ignored), "{:?}", table.assumptions);

    let text = case("pnezd.csv").unwrap();
    let table = parse(&text);
    let labels: Vec<_> = table.rows.iter().map(|row| row.as_ref().unwrap().label.clone().unwrap()).collect();
    assert_eq!(labels, ["TGT", "TGT", "TGT", "NAIL"]);
    assert!(matches!(table.undecided().next(), Some(Assumption::AxisOrder { .. })));
    let chosen = parse_with(&text, TableChoices { axes: Some(Axes::Yx), ..TableChoices::default() });
    let xyz = chosen.rows[0].as_ref().unwrap().point.xyz;
    assert_eq!((xyz, chosen.undecided().count()), (Some([3000.456, 5000.123, 101.231]), 0));

    let table = parse(&case("korean_head.csv").unwrap());
    let first = &table.rows[0].as_ref().unwrap().point;
    assert_eq!((first.id.as_str(), first.xyz), ("1", Some([205_000.123, 545_000.456, 31.123])));

    let table = parse(&case("facade-control-mirrored.csv").unwrap());
    let first = &table.rows[0].as_ref().unwrap().point;
    assert_eq!((first.id.as_str(), first.xyz), ("벽1", Some([201_225.968, 451_231.908, 35.899])));
}

#[test]
fn imports_tell_what_they_assumed() {
    let files = |all: &[(&str, &str)]| -> Files {
        all.iter().map(|(name, text)| ((*name).to_owned(), text.as_bytes().to_vec())).collect()
    };
    let two =
        files(&[("a.csv", "id,X [m],Y [m],Z [m]\n1,1.5,2,3\n"), ("b.csv", "id,X [mm],Y [mm],Z [mm]\n2,500,2,3\n")]);
    let imported = import_with("control-csv", &two, TableChoices::default()).unwrap();
    assert_eq!(imported.project.unit, "m");
    assert_eq!(imported.project.points[1].xyz, Some([0.5, 0.002, 0.003]));
    assert_eq!(imported.assumptions.len(), 2);
    let json = serde_json::to_value(&imported).unwrap();
    assert_eq!(json["assumptions"][0]["file"], "a.csv");
    let kinds: Vec<&str> =
        json["assumptions"][0]["assumptions"].as_array().unwrap().iter().map(|a| a["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["separator", "decimal_sign", "columns", "axis_order", "unit"]);
    assert_eq!(json["unit"], "m");
    let open = files(&[("a.csv", "1\t1,234\t2,345\t3,456\n")]);
    let error = import_with("control-csv", &open, TableChoices::default()).unwrap_err();
    assert!(error.to_string().contains("1.234") && error.to_string().contains("1234"), "{error}");
}
