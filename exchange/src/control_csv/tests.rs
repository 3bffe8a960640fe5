//! Tests with control tables of many programs.

use super::*;
use sightline::axes::UserAxes;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

fn points(text: &str) -> Vec<Point> {
    parse(text).into_points().unwrap_or_else(|error| panic!("{error}\n{text}"))
}

#[test]
fn one_table_in_every_dress() {
    let plain = points("id,X,Y,Z,sX,sY,sZ\n7,0.5,1.25,-3,0.01,0.02,0.03\n8,1,2,3,0.01,0.02,0.03\n");
    assert_eq!(plain[0].xyz, Some([0.5, 1.25, -3.0]));
    assert_eq!(plain[0].sigma, Some([Some(0.01), Some(0.02), Some(0.03)]));
    for dress in [
        "7,0.5,1.25,-3,0.01,0.02,0.03\n8,1,2,3,0.01,0.02,0.03",
        "7\t0.5\t1.25\t-3\t0.01\t0.02\t0.03\r\n8\t1\t2\t3\t0.01\t0.02\t0.03\r\n",
        "7\t0,5\t1,25\t-3\t0,01\t0,02\t0,03\n8\t1\t2\t3\t0,01\t0,02\t0,03",
        "7;0,5;1,25;-3;0,01;0,02;0,03\n8;1;2;3;0,01;0,02;0,03",
        "7 0.5 1.25 -3 0.01 0.02 0.03\n8 1 2 3 0.01 0.02 0.03",
        "7 0,5 1,25 -3 0,01 0,02 0,03\n8 1 2 3 0,01 0,02 0,03",
        "# a comment\n\n7, 0.5, 1.25, -3, 0.01, 0.02, 0.03\n% another\n8, 1, 2, 3, 0.01, 0.02, 0.03",
        "7,CP1,0.5,1.25,-3,0.01,0.02,0.03\n8,CP2,1,2,3,0.01,0.02,0.03",
        "Z [m];Y [m];X [m];sigma_x;sigma_y;sigma_z;Name\n-3;1,25;0,5;0,01;0,02;0,03;7\n3;2;1;0,01;0,02;0,03;8",
        "\"id\",\"x\",\"y\",\"z\",\"σx\",\"σy\",\"σz\"\n\"7\",\"0.5\",\"1.25\",\"-3\",0.01,0.02,0.03\n\"8\",1,2,3,0.01,0.02,0.03",
        "점번호,X,Y,Z,sX,sY,sZ\n7,0.5,1.25,-3,0.01,0.02,0.03\n8,1,2,3,0.01,0.02,0.03",
    ] {
        assert_eq!(points(dress), plain, "{dress}");
    }
}

#[test]
fn sigmas_may_be_absent_common_or_fixed() {
    assert_eq!(points("1,0,1,0\n2,1,1,0")[0].sigma, None);
    assert_eq!(points("1001,CP1,0,1,0\n1002,CP2,1,1,0")[1].xyz, Some([1.0, 1.0, 0.0]));
    assert_eq!(points("1 0 1 0 0.2")[0].sigma, Some([Some(0.2); 3]));
    assert_eq!(points("2 -0.2 -0.1 -0.3 fix fix 0.5 99 0")[0].sigma, Some([None, None, Some(0.5)]));
    assert_eq!(points("id;x;y;z;sx;sy;sz\n1;0;1;0;0;;-")[0].sigma, Some([Some(0.0), None, None]));
    assert_eq!(points("id,x,y,z,role\n1,0,1,0,check\n2,0,1,0,")[0].role, Role::Check);
}

#[test]
fn a_bad_row_is_named_and_the_others_are_kept() {
    let table = parse(
        "id,X,Y,Z,sX,sY,sZ\n1,0,1,0,,,\n2,0,one,0,,,\n1,5,5,5,,,\n3,0,1\n4,0,1,0,-1,,\n,0,1,0,,,\n5,inf,0,0,,,\n6,1,2,3,,,\n",
    );
    let (points, errors) = table.split();
    assert_eq!(points.iter().map(|point| point.id.as_str()).collect::<Vec<_>>(), ["1", "6"]);
    let places: Vec<_> = errors.iter().map(|error| (error.code(), error.place().line, error.place().field)).collect();
    let field = |name: &str| Some(name.to_owned());
    assert_eq!(
        places,
        [
            ("invalid", Some(3), field("Y")),
            ("duplicate", Some(4), None),
            ("invalid", Some(5), field("Z")),
            ("invalid", Some(6), field("sX")),
            ("invalid", Some(7), field("id")),
            ("invalid", Some(8), field("X")),
        ]
    );
}

#[test]
fn a_rejected_line_speaks_the_words_of_the_list() {
    let said = |text: &str, choices: TableChoices| {
        let (_, errors) = parse_with(text, choices).split();
        let named: Vec<_> = errors.iter().map(|error| error.place().field.unwrap_or_default()).collect();
        let whole = errors.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
        assert!(named.iter().all(|name| whole.contains(name)), "{whole}");
        named.join(" ")
    };
    let none = TableChoices::default;
    assert_eq!(said("점명,종(N),횡(E),표고\n1,2,3,4\n2,two,3,4\n3,2,three,4\n4,2,3,\n", none()), "종(N) 횡(E) 표고");
    assert_eq!(
        said("Name;Hochwert;Rechtswert;Höhe [m]\n1;2;3;4\n2;2;drei;4\n3;2;3;vier\n", none()),
        "Rechtswert Höhe [m]"
    );
    // Without a heading by the axes of the user, in whatever order the list is.
    let north = TableChoices { axes: Some(Axes::Yx), ..none() };
    assert_eq!(
        said("1,2,3,4,0.1,0.1,0.1\n2,two,3,4,0.1,-1,0.1\n3,2,three,4\n4,1,2,3,0.1,-1,0.1", north.clone()),
        "N E sE"
    );
    let project = TableChoices { project_axes: Some(UserAxes::Enh), axes: Some(Axes::Xy), ..none() };
    assert_eq!(said("1,2,3,4\n2,two,3,4\n3,2,three,4\n", project), "E N");
    assert_eq!(said("1,2,3,4\n2,two,3,4\n3,2,three,4\n", none()), "X Y");
}

#[test]
fn decimal_marks_are_not_guessed() {
    for mixed in ["1;0,5;1.234,5;0", "1;0,5;1.234;0", "1\t0.5\t1,234\t0"] {
        let error = parse(mixed).into_points().unwrap_err();
        assert_eq!(error.place().field.as_deref(), Some("Y"), "{mixed}");
    }
}

#[test]
fn no_text_is_too_odd() {
    assert_eq!(parse("").into_points().unwrap_err().code(), "empty");
    assert_eq!(parse("id,X,Y,Z\n").into_points().unwrap_err().code(), "empty");
    for odd in ["\u{0}\u{1}", ",,,,\n;;;", "a", "1,2,3", "\"", "1,\"2,3,4\n5,6,7,8", "x,y,z\n1,2,3", "ä ö ü ß"] {
        assert!(parse(odd).into_points().is_err(), "{odd:?}");
    }
}

#[test]
fn a_quoted_field_may_hold_a_line_break() {
    let table = parse("id,X,Y,Z\n\"two\nlines\",1,2,3\n# a, comment\n8,1,zwei,3\n");
    let (points, errors) = table.split();
    assert_eq!(points[0].id, "two\nlines");
    assert_eq!(errors[0].place(), Place::line(5).with_field("Y"));
}

#[test]
fn what_is_written_is_read_again() {
    let mut all = points(
        "id,x,y,z,sx,sy,sz,role\n1,0.1,1e-3,-7.25,0.01,,0,control\n\"a,b\",1,2,3,,,,check\n\"two\nlines\",1,2,3\n\"#1\",1,2,3",
    );
    all.push(Point { id: "without coordinates".into(), ..Point::default() });
    for axes in [None, Some(UserAxes::Enh), Some(UserAxes::Neh)] {
        let again = points(&write(&all, ShownAxes::of(axes)));
        assert_eq!(again, all[..4], "{axes:?}");
    }
}

#[test]
fn angles_are_told_from_numbers() {
    for angle in
        ["37°30'15.2\"N", "37-30-15.2", "37:30:15", "37d30m15.2s", "37 30 15.2", "-127 01 02,5", "N37.504", "127도"]
    {
        assert!(angles::is_angle(angle), "{angle}");
        let errors = parse(&format!("id;X;Y;Z\n1;{angle};2;3\n")).split().1;
        assert!(
            matches!(ExchangeReason::of_error(&errors[0]), Some(ExchangeReason::AngleUnexpected { .. })),
            "{angle}"
        );
    }
    for other in ["12 345 678.5", "1 234 567", "2026-11-29", "-37.5", "37 75 10", "1e-3", "a b c", "1-2", "0 3"] {
        assert!(!angles::is_angle(other), "{other}");
    }
}
