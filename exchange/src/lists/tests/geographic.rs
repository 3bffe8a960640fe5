//! Latitudes, longitudes and ellipsoidal heights become east, north and up.

use super::*;
use crate::reason::ExchangeReason;
use control_csv::AngleForm;
use sightline::project::{LocalSystem, ReferenceEllipsoid};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

/// The mean of the three points of [`WANTED`], rounded.
const SYSTEM: LocalSystem =
    LocalSystem { ellipsoid: ReferenceEllipsoid::Wgs84, latitude: 37.5035, longitude: 127.0343, height: 31.0 };

/// 37°30'12.5"N 127°02'03.4"E 30.5 m, 37°30'14.25"N 127°02'01.0"E 31.25 m, 37°30'11.0"N 127°02'05.9"E 32 m in that system, by PROJ 9.5.1
/// (pyproj 3.7.2): `+proj=cart +ellps=WGS84`, then `+proj=topocentric +lat_0=37.5035 +lon_0=127.0343 +h_0=31`.
const WANTED: [[f64; 3]; 3] = [
    [-1.964_928_260, -3.082_989_623, -0.500_001_049],
    [-60.912_388_316, 50.869_563_623, 0.249_506_036],
    [59.439_424_179, -49.327_635_269, 0.999_532_064],
];

fn with(text: &str, choices: &TableChoices) -> PointList {
    read(text.as_bytes(), choices).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn assert_wanted(list: &PointList, within: f64, what: &str) {
    assert!(list.rejected.is_empty() && list.points.len() == WANTED.len(), "{what}: {list:?}");
    for (row, wanted) in list.points.iter().zip(WANTED) {
        let found = row.point.xyz.unwrap();
        assert!((0..3).all(|k| (found[k] - wanted[k]).abs() < within), "{what}: {found:?} {wanted:?}");
    }
}

fn system(list: &PointList) -> (LocalSystem, AngleForm, Basis) {
    let of = |a: &Assumption| match a {
        Assumption::LocalSystem { system, form, by, .. } => Some((*system, *form, *by)),
        _ => None,
    };
    list.assumptions.iter().find_map(of).expect("a local system")
}

#[test]
fn every_form_gives_the_coordinates_of_proj() {
    let sexagesimal = [
        "id;lat;lon;h\n1;37°30'12.5\";127°02'03.4\";30.5\n2;37°30'14.25\";127°02'01.0\";31.25\n3;37°30'11.0\";127°02'05.9\";32\n",
        "점명,위도,경도,타원체고\n1,37 30 12.5,127 02 03.4,30.5\n2,37 30 14.25,127 02 01.0,31.25\n3,37 30 11.0,127 02 05.9,32\n",
        "Punkt;Länge;Breite;Höhe [m]\n1;127d02m03,4s;37d30m12,5s;30,5\n2;127d02m01,0s;37d30m14,25s;31,25\n3;127d02m05,9s;37d30m11,0s;32\n",
        "点名\t緯度\t経度\t楕円体高\n1\tN37-30-12.5\tE127-02-03.4\t30.5\n2\tN37-30-14.25\tE127-02-01.0\t31.25\n3\tN37-30-11.0\tE127-02-05.9\t32\n",
        // Without a heading, or under X and Y, the letters say which is which.
        "1,37:30:12.5N,127:02:03.4E,30.5\n2,37:30:14.25N,127:02:01.0E,31.25\n3,37:30:11.0N,127:02:05.9E,32\n",
        "id,X,Y,Z\n1,37°30'12.5\"N,127°02'03.4\"E,30.5\n2,37°30'14.25\"N,127°02'01.0\"E,31.25\n3,37°30'11.0\"N,127°02'05.9\"E,32\n",
        "id,Easting,Northing,Z\n1,127°02'03.4\",37°30'12.5\",30.5\n2,127°02'01.0\",37°30'14.25\",31.25\n3,127°02'05.9\",37°30'11.0\",32\n",
        // Only a longitude can be above 90.
        "1 37°30'12.5\" 127°02'03.4\" 30.5\n2 37°30'14.25\" 127°02'01.0\" 31.25\n3 37°30'11.0\" 127°02'05.9\" 32\n",
    ];
    for text in sexagesimal {
        let read = list(text);
        assert_wanted(&read, 1e-8, text);
        assert_eq!(system(&read), (SYSTEM, AngleForm::Sexagesimal, Basis::Convention), "{text}");
        assert_eq!((read.unit, &read.undecided[..]), (Some(Unit::Metre), &[][..]), "{text}");
    }
    // Metashape, RealityCapture and Pix4D write decimal degrees; ten decimals are 10 µm.
    for text in [
        "#Label,X/Longitude,Y/Latitude,Z/Altitude\n1,127.0342777778,37.5034722222,30.5\n2,127.0336111111,37.5039583333,31.25\n3,127.0349722222,37.5030555556,32\n",
        "#name,lat,long,alt\n1,37.5034722222,127.0342777778,30.5\n2,37.5039583333,127.0336111111,31.25\n3,37.5030555556,127.0349722222,32\n",
        "Label,Latitude (WGS84),Longitude [deg],Height [mm]\n1,37.5034722222,127.0342777778,30500\n2,37.5039583333,127.0336111111,31250\n3,37.5030555556,127.0349722222,32000\n",
        "id;lat_deg;lon_deg;h\n1;37,5034722222;127,0342777778;30,5\n2;37,5039583333;127,0336111111;31,25\n3;37,5030555556;127,0349722222;32\n",
    ] {
        let read = list(text);
        assert_wanted(&read, 2e-5, text);
        assert_eq!(system(&read), (SYSTEM, AngleForm::Degrees, Basis::Convention), "{text}");
        assert!(!read.assumptions.iter().any(|a| matches!(a, Assumption::AxisOrder { .. })), "{text}");
    }
}

#[test]
fn a_given_origin_is_used_and_standard_errors_stay_metres() {
    let given = LocalSystem { latitude: 37.5, longitude: 127.0, height: 0.0, ..SYSTEM };
    let choices = TableChoices { local_system: Some(given), ..TableChoices::default() };
    let text = "id,lat,lon,h,slon,slat,sh\n1,37.5,127.0,12.5,0.01,0.02,0.03\n2,37.501,127,12.5,,,\n";
    let read = with(text, &choices);
    assert_eq!(system(&read), (given, AngleForm::Degrees, Basis::Given));
    let [one, two] = &read.points[..] else { panic!("{read:?}") };
    assert!((one.point.xyz.unwrap()[2] - 12.5).abs() < 1e-8);
    assert_eq!(one.point.sigma, Some([Some(0.01), Some(0.02), Some(0.03)]));
    assert!((two.point.xyz.unwrap()[1] - 110.99).abs() < 0.01, "{two:?}");
    // Metashape's X is the longitude, so is the standard error of X. Heights in feet do not change those with a unit of their own.
    let text = "#Label,X/Longitude,Y/Latitude,Z/Altitude [ft],Accuracy_X [mm],Accuracy_Y [mm],Accuracy_Z [mm]\n1,127,37.5,10,1,2,3\n";
    let read = with(text, &choices);
    assert!((read.points[0].point.xyz.unwrap()[2] - 3.048).abs() < 1e-8, "{read:?}");
    assert_eq!(read.points[0].point.sigma, Some([Some(0.001), Some(0.002), Some(0.003)]));
    let all = "#Label,X/Longitude,Y/Latitude,Z/Altitude,Accuracy_X/Y/Z_(m)\n1,127,37.5,10,0.005\n";
    assert_eq!(with(all, &choices).points[0].point.sigma, Some([Some(0.005); 3]));
}

#[test]
fn what_is_no_place_is_rejected_by_line() {
    let read = list(concat!(
        "id;lat;lon;h\n",
        "1;37°30'12.5\";127°02'03.4\";30.5\n",
        "2;37°30'14.25\";127°02'01.0\";31.25\n",
        "3;37°30'14\";127°02'01\";31.25\n",
        "4;37.5034;127°02'01.0\";31.25\n",
        "5;91°00'01\";127°02'01.0\";31.25\n",
        "6;37°30'01\";181°02'01.0\";31.25\n",
        "7;37°30'01\"E;127°02'01.0\";31.25\n",
        "8;37°61'01\";127°02'01.0\";31.25\n",
        "9;-37°30'01\"S;127°02'01.0\";31.25\n",
        "10;37°30'01\";127°02'01.0\";31°15'\n",
        "11;37;127°;31.25\n",
        "12;37°30'01\";;31.25\n",
    ));
    let ids: Vec<&str> = read.points.iter().map(|row| row.point.id.as_str()).collect();
    // Whole degrees are of either form.
    assert_eq!(ids, ["1", "2", "3", "11"]);
    let lines: Vec<usize> = read.rejected.iter().map(|one| one.line).collect();
    assert_eq!(lines, [5, 6, 7, 8, 9, 10, 11, 13]);
    let why: Vec<Option<ExchangeReason>> =
        read.rejected.iter().map(|one| ExchangeReason::of_error(&one.error)).collect();
    assert!(matches!(why[0], Some(ExchangeReason::AngleForm { .. })));
    assert!(matches!(why[1], Some(ExchangeReason::AngleOutside { .. })));
    assert!(matches!(why[2], Some(ExchangeReason::AngleOutside { .. })));
    assert!(matches!(why[3], Some(ExchangeReason::AngleDirection { .. })));
    assert!(matches!(why[4], Some(ExchangeReason::NotAnAngle { .. })));
    assert!(matches!(why[5], Some(ExchangeReason::NotAnAngle { .. })));
    assert!(matches!(why[6], Some(ExchangeReason::AngleUnexpected { .. })));
    assert_eq!(read.rejected[1].message, "lat is outside ±90°: \"91°00'01\"\" (line 6, field lat)");
}

#[test]
fn what_nothing_decides_is_asked() {
    // Two angles below 90 without letters or names.
    let text = "1;7°30'12.5\";46°02'03.4\";430.5\n2;7°30'14.5\";46°02'01.0\";431.5\n";
    let read = list(text);
    assert!(matches!(read.undecided[..], [Assumption::Columns { .. }]), "{read:?}");
    let columns = Some([Field::Id, Field::Longitude, Field::Latitude, Field::Z].map(Some).to_vec());
    let chosen = TableChoices { columns, ..TableChoices::default() };
    let read = with(text, &chosen);
    assert!(read.undecided.is_empty() && read.rejected.is_empty());
    assert_eq!((system(&read).0.latitude, system(&read).0.longitude), (46.0339, 7.5038));
    // One of the two, the height or a unit that is not degrees is missing or wrong: no line is taken.
    for (text, said) in [
        ("id,lat,X,Z\n1,37.5,127.1,30\n", "no column longitude"),
        ("#Label,Longitude,Latitude,Error_(m)\n1,127.1,37.5,0.01\n", "no column Z"),
        ("id,lat (gon),lon (gon),h\n1,37.5,127.1,30\n", "gon"),
        ("id,lat [m],lon [m],h\n1,37.5,127.1,30\n", "\"m\""),
    ] {
        let read = list(text);
        assert!(read.points.is_empty() && read.rejected[0].message.contains(said), "{text}: {read:?}");
    }
    let beside = TableChoices {
        columns: Some([Field::Id, Field::X, Field::Latitude, Field::Z].map(Some).to_vec()),
        ..TableChoices::default()
    };
    assert!(with(text, &beside).points.is_empty());
    // Beside coordinates of a plane they are left alone.
    let both = list("id,E [m],N [m],H [m],lat,lon\n1,5.5,6.5,7.5,37.5,127.1\n");
    assert_eq!(both.points[0].point.xyz, Some([5.5, 6.5, 7.5]));
    assert!(both.assumptions.contains(&Assumption::Ignored { columns: vec!["lat".into(), "lon".into()] }));
}

#[test]
fn lists_of_one_project_share_their_origin() {
    let list = |rows: &str| format!("id,lat,lon,h\n{rows}").into_bytes();
    let files: crate::Files = [
        ("a.csv".to_owned(), list("1,37.5,127.0,10\n2,37.5002,127.0,10\n")),
        ("b.csv".to_owned(), list("3,37.6,127.1,10\n")),
    ]
    .into();
    let read = crate::import_with("control-csv", &files, TableChoices::default()).unwrap();
    let origin = read.project.origin.as_deref().expect("an origin");
    let system = origin.local_system.expect("a local system");
    assert_eq!((origin.format.as_str(), system.latitude, read.project.unit.as_str()), ("control-csv", 37.5001, "m"));
    assert!(read.project.points[2].xyz.unwrap()[1] > 11_000.0);
    let plain: crate::Files = [("a.csv".to_owned(), b"id,X,Y,Z\n1,2,3,4\n".to_vec())].into();
    assert_eq!(crate::import("control-csv", &plain).unwrap().origin, None);
    // Epochs are compared: none has an origin of its own.
    let text = String::from_utf8(list("1,37.5,127.0,10\n2,37.5002,127.0,10\n")).unwrap();
    let error = crate::epochs::points(&text, TableChoices::default()).unwrap_err();
    assert_eq!(ExchangeReason::of_error(&error), Some(ExchangeReason::GeographicOrigin));
    let given = TableChoices { local_system: Some(system), ..TableChoices::default() };
    assert_eq!(crate::epochs::points(&text, given).unwrap().points.len(), 2);
}
