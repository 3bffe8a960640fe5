//! Lists of instruments and programs, by hand and at random; any bytes end in a result.

mod geographic;

use super::*;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

fn list(text: &str) -> PointList {
    read(text.as_bytes(), &TableChoices::default()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn found(list: &PointList) -> Vec<(&str, [f64; 3], Option<&str>)> {
    list.points.iter().map(|row| (row.point.id.as_str(), row.point.xyz.unwrap(), row.label.as_deref())).collect()
}

fn left(list: &PointList, wanted: Beside) -> usize {
    let of = |a: &Assumption| match a {
        Assumption::Beside { what, count } if *what == wanted => Some(*count),
        _ => None,
    };
    list.assumptions.iter().find_map(of).unwrap_or(0)
}

#[test]
fn leica_gsi_in_both_widths() {
    let eight = "110001+0000P001 81..00+00012345 82..00-00023456 83..06+00123456\n110002+00000007 21.022+05432100 31..00+00012345\n";
    let read = list(eight);
    assert_eq!(found(&read), [("P001", [12.345, -23.456, 12.3456], None)]);
    assert_eq!((read.unit, left(&read, Beside::Measurements)), (Some(Unit::Metre), 1));
    let sixteen = "*110001+00000000000000A1 81..08+0000020500012345 82..08+0000054500045678 83..08+0000000003112300 71....+000000000000NAIL\n";
    assert_eq!(found(&list(sixteen)), [("A1", [205_000.123_45, 545_000.456_78, 31.123], Some("NAIL"))]);
    // Of feet it is asked which; a missing height is told, and so is a broken word.
    let odd = list(
        "110001+00000001 81..01+00001000 82..01+00002000 83..01+00003000\n110002+00000002 81..01+00001000 82..01+00002000\n110003+00000003 81..01+0000x000 82..01+00002000 83..01+00001000\n",
    );
    assert_eq!((odd.points.len(), odd.rejected.len(), odd.unit), (1, 2, None));
    assert_eq!(odd.rejected[0].error.place(), Place::line(2).with_field("Z"));
}

#[test]
fn sokkia_sdr_by_its_places() {
    let text = concat!(
        "00NMSDR33 V04-04.02     00-000-00 00:00 111111\n",
        "10NMJOB3            121111\n",
        "02TP        00000031509.97000000    937.27400000    20.05300000     1.50500000      BM              \n",
        "08TP        00000009510.50400000    908.83800000    19.69900000     11              \n",
        "09F1            0001            00021.00000000      90.0000000      0.00000000\n",
    );
    let read = list(text);
    let wanted = [("31", [937.274, 509.97, 20.053], Some("BM")), ("9", [908.838, 510.504, 19.699], Some("11"))];
    assert_eq!(found(&read), wanted);
    assert_eq!((read.unit, read.undecided.len(), left(&read, Beside::Measurements)), (Some(Unit::Metre), 0, 1));
    // Feet are asked, and so is the order where the header has east first.
    let read = list(&text.replace("111111\n10", "121121\n10"));
    assert!(matches!(read.undecided[..], [Assumption::AxisOrder { .. }]) && read.unit.is_none());
    let given = TableChoices { axes: Some(Axes::Yx), unit: Some(Unit::Foot), ..TableChoices::default() };
    let read = super::read(text.replace("111111\n10", "121121\n10").as_bytes(), &given).unwrap();
    assert_eq!((found(&read)[0].1, read.unit, read.undecided.len()), ([509.97, 937.274, 20.053], Some(Unit::Foot), 0));
    let short = concat!(
        "00NMSDR20V03-05     0000 1-Jan-00 00:00 111111\n",
        "08KI00075000.123  3000.456  101.231   TGT             \n"
    );
    assert_eq!(found(&list(short)), [("7", [3000.456, 5000.123, 101.231], Some("TGT"))]);
}

#[test]
fn trimble_job_xml_and_land_xml_by_name() {
    let job = "<?xml version=\"1.0\"?>\n<JOBFile jobName=\"a\"><FieldBook><PointRecord><Name>x</Name></PointRecord></FieldBook>\n<Reductions>\n<Point><ID>1</ID><Name>P 1</Name><Code>TGT</Code><Grid><North>545000.456</North><East>205000.123</East><Elevation>31.123</Elevation></Grid></Point>\n<Point><Name>P2</Name><Grid><North>?</North><East>1</East><Elevation>2</Elevation></Grid></Point>\n<Point><Name>P3</Name><Deleted>true</Deleted></Point>\n<Point><Name>P4</Name><WGS84><Latitude>37</Latitude></WGS84></Point></Reductions></JOBFile>";
    let read = list(job);
    assert_eq!(found(&read), [("P 1", [205_000.123, 545_000.456, 31.123], Some("TGT"))]);
    assert_eq!((read.points[0].line, read.rejected[0].line, read.unit), (4, 5, Some(Unit::Metre)));
    assert_eq!((left(&read, Beside::Deleted), left(&read, Beside::Geographic)), (1, 1));
    let land = "<?xml version=\"1.0\"?>\n<LandXML xmlns=\"x\"><Units><Imperial linearUnit=\"USSurveyFoot\"/></Units>\n<CgPoints><CgPoint name=\"가\" code=\"c\">2 1 3</CgPoint>\n<CgPoint oID=\"7\" desc=\"d\">5 4</CgPoint><CgPoint name=\"r\" pntRef=\"가\"/></CgPoints></LandXML>";
    let read = list(land);
    assert_eq!(found(&read), [("가", [1.0, 2.0, 3.0], Some("c"))]);
    assert_eq!((read.unit, read.rejected.len(), left(&read, Beside::References)), (Some(Unit::SurveyFoot), 1, 1));
    assert!(super::read(b"<LandXML><CgPoints>", &TableChoices::default()).is_err());
}

#[test]
fn ground_control_of_odm() {
    let text = "WGS84 UTM 16N\n1 2 3 10 20 a.jpg gcp1\n1 2 3 11 21 b.jpg gcp1\n4 5 6 1 2 a.jpg gcp2\n4 5 7 1 2 b.jpg gcp2\n4 5\n";
    let read = list(text);
    assert_eq!(found(&read), [("gcp1", [1.0, 2.0, 3.0], None), ("gcp2", [4.0, 5.0, 6.0], None)]);
    assert_eq!((read.rejected.len(), left(&read, Beside::ImageMeasurements), read.unit), (2, 4, Some(Unit::Metre)));
    let nameless = list("EPSG:5186\n1 2 3 10 20 a.jpg\n1 2 3 10 20 b.jpg\n9 2 3 10 20 b.jpg\n");
    assert_eq!(found(&nameless).iter().map(|p| p.0).collect::<Vec<_>>(), ["GCP 1", "GCP 2"]);
    assert!(nameless.assumptions.contains(&Assumption::NamesMade { count: 2 }) && nameless.unit.is_none());
    // In degrees: longitude before latitude.
    let degrees = list("EPSG:4326\n127.2 37.1 3 10 20 a.jpg g\n37.1 127.2 3 10 20 a.jpg h\n");
    assert_eq!((degrees.points.len(), degrees.rejected.len(), degrees.unit), (1, 1, Some(Unit::Metre)));
    assert!(degrees.points[0].point.xyz.unwrap()[0].abs() < 1e-6, "the origin is the point itself");
}

#[test]
fn tables_of_programs() {
    let metres = TableChoices { unit: Some(Unit::Metre), ..TableChoices::default() };
    // Pix4D: horizontal and vertical accuracy; without a heading the two columns are asked.
    let pix4d =
        "Label,Easting,Northing,Height,Horizontal Accuracy (m),Vertical Accuracy (m)\ng1,1.5,2.5,3.5,0.01,0.02\n";
    let found = read(pix4d.as_bytes(), &metres).unwrap();
    assert_eq!(found.points[0].point.sigma, Some([Some(0.01), Some(0.01), Some(0.02)]));
    let bare = "g1,1.5,2.5,3.5,0.01,0.02\ng2,4.5,5.5,6.5,0.01,0.02\n";
    assert!(matches!(list(bare).undecided[..], [Assumption::Columns { .. }, ..]));
    let columns = Some([Field::Id, Field::X, Field::Y, Field::Z, Field::Sxy, Field::Sz].map(Some).to_vec());
    let chosen = read(bare.as_bytes(), &TableChoices { columns, ..TableChoices::default() }).unwrap();
    assert_eq!(chosen.points[1].point.sigma, Some([Some(0.01), Some(0.01), Some(0.02)]));
    assert!(chosen.undecided.is_empty());
    // A whole number behind decimals may be a code.
    assert!(matches!(list("1,5.5,6.5,7.5,3\n2,5.1,6.1,7.1,4\n").undecided[..], [Assumption::Columns { .. }, ..]));
    assert!(list("1,5.5,6.5,7.5,0.3\n2,5.1,6.1,7.1,0.4\n").undecided.is_empty());
    // RealityCapture, CASS (empty code before the east), a title before the heading, target diameters.
    assert_eq!(list("#name,x,y,alt\nM1,1.5,2.5,3.5\n").points[0].point.xyz, Some([1.5, 2.5, 3.5]));
    let cass = list("1,,53414.28,31421.88,39.555\n2,,53387.8,31425.02,36.877\n");
    assert_eq!((cass.points[0].point.xyz, cass.undecided.len()), (Some([53_414.28, 31_421.88, 39.555]), 0));
    let titled = list(
        "Hall 4, total station\n2026-11-20\nPunkt;Rechtswert;Hochwert;Höhe;Durchmesser\na;1,5;2,5;3,5;12,5\nb;2,5;2,5;3,5;12,5\nc;3,5;2,5;3,5;12,5\n",
    );
    assert_eq!((titled.points[0].point.diameter, titled.points[0].line), (Some(12.5), 4));
    assert_eq!(left(&titled, Beside::LinesBefore), 2);
    // Chosen columns leave the heading where it is.
    let columns = Some([Field::Id, Field::Y, Field::X, Field::Z, Field::Diameter].map(Some).to_vec());
    let text = "Hall 4\nPunkt;Rechtswert;Hochwert;Höhe;Durchmesser\na;1,5;2,5;3,5;12,5\nb;2,5;2,5;3,5;12,5\n";
    let chosen = read(text.as_bytes(), &TableChoices { columns, ..TableChoices::default() }).unwrap();
    assert_eq!((chosen.heading.len(), chosen.points.len(), chosen.rejected.len()), (5, 2, 0));
    assert_eq!(chosen.points[0].point.xyz, Some([2.5, 1.5, 3.5]));
    for heading in
        ["nom,est,nord,altitude", "点名,東,北,標高", "점명,횡(E),종(N),표고", "点号,东,北,高程", "Name,Ost,Nord,Höhe"]
    {
        let found = list(&format!("{heading}\na,1.5,2.5,3.5\n"));
        assert_eq!(found.points[0].point.xyz, Some([1.5, 2.5, 3.5]), "{heading}");
    }
    // What the caller says counts.
    let text = "a list\nwords;here;and;there\n1;2;3;4\n2;3;4;5\n";
    let choices =
        TableChoices { first_line: Some(4), sigma_unit: Some(Unit::Millimetre), axes: Some(Axes::Xy), ..metres };
    assert_eq!(read(text.as_bytes(), &choices).unwrap().points.len(), 1);
    let sigmas = "id;X;Y;Z;sigma\n1;2,5;3;4;0,8\n";
    let scaled = read(sigmas.as_bytes(), &choices_without_line(&choices)).unwrap();
    assert_eq!(scaled.points[0].point.sigma, Some([Some(0.0008); 3]));
}

fn choices_without_line(choices: &TableChoices) -> TableChoices {
    TableChoices { first_line: None, ..choices.clone() }
}

#[test]
fn any_bytes_end_in_a_result() {
    let seeds: [&[u8]; 11] = [
        b"110001+0000P001 81..00+00012345 82..00-00023456 83..06+00123456\n",
        b"00NMSDR33 V04-04.02     00-000-00 00:00 111121\n08TP        00000009510.50400000    908.83800000    19.69900000     11\n",
        b"<JOBFile><Reductions><Point><Name>a</Name><Grid><North>1</North><East>2</East><Elevation>3</Elevation></Grid></Point></Reductions></JOBFile>",
        b"<LandXML><Units><Metric linearUnit=\"meter\"/></Units><CgPoints><CgPoint name=\"a\">1 2 3</CgPoint></CgPoints></LandXML>",
        b"EPSG:32610\n1 2 3 10 20 a.jpg gcp1\n",
        b"#Label,X/Easting,Y/Northing,Z/Altitude,Error_(m)\nt1,0.0,0.5,0.0,0.0021\n",
        "점명;X좌표;Y좌표;표고;지름\n1;1,5;2,5;3,5;4\n".as_bytes(),
        b"P1,1,234,2,345,3,456\n1 37-30-15.2N 127\xb03' 5\n",
        "id;lat;lon;h\n1;37°30'12.5\";127°02'03.4\";30.5\n2;N 37 30 12,5;E127d2m3s;31\n".as_bytes(),
        b"#Label,X/Longitude,Y/Latitude,Z/Altitude\n1,127.1,37.5,30\n2,-181,37,30\n",
        b"title\nid\tN [m]\tE [m]\tH [ft]\tsN\tsE\n\"a\nb\"\t1\t2\t3\n",
    ];
    // Knuth's generator of MMIX; its upper bits are good enough for damage.
    let mut state = 31_u64;
    let mut below = |n: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % n.max(1)
    };
    for round in 0..6000 {
        let mut bytes = seeds[round % seeds.len()].repeat(1 + below(3));
        for _ in 0..below(12) {
            let at = below(bytes.len());
            match below(5) {
                0 => bytes[at] = below(256) as u8,
                1 => drop(bytes.remove(at)),
                2 => bytes.insert(at, b"\n,;\t \"'.-+eE0<>&#%\xff\x00NdW\xb0"[below(24)]),
                3 => bytes.truncate(at.max(1)),
                _ => {
                    let from = below(bytes.len());
                    bytes[at] = bytes[from];
                }
            }
            if bytes.is_empty() {
                break;
            }
        }
        let any = |n: usize, below: &mut dyn FnMut(usize) -> usize| below(n);
        let fields = [
            Field::Id,
            Field::X,
            Field::Y,
            Field::Z,
            Field::Sxy,
            Field::Diameter,
            Field::Role,
            Field::Latitude,
            Field::Longitude,
        ];
        let choices = TableChoices {
            encoding: [None, None, Some(Encoding::Cp949), Some(Encoding::Windows1252), Some(Encoding::Utf16)]
                [any(5, &mut below)],
            first_line: [None, None, Some(0), Some(2), Some(usize::MAX)][any(5, &mut below)],
            columns: (below(4) == 0).then(|| (0..below(9)).map(|_| (below(4) > 0).then(|| fields[below(9)])).collect()),
            axes: [None, Some(Axes::Yx)][any(2, &mut below)],
            separator: [None, Some(control_csv::Separator::Blanks), Some(control_csv::Separator::Tab)]
                [any(3, &mut below)],
            sigma: control_csv::SigmaRule::read("2 mm + 2 ppm").ok().filter(|_| below(2) == 0),
            ..TableChoices::default()
        };
        let Ok(list) = read(&bytes, &choices) else { continue };
        for row in &list.points {
            let all = row.point.xyz.iter().flatten().chain(row.point.sigma.iter().flatten().flatten());
            assert!(all.into_iter().all(|value| value.is_finite()), "{row:?}");
        }
        assert!(serde_json::to_string(&list).is_ok());
    }
}
