use super::*;
use sightline::adjustment::{AdjustedCamera, Correlation};
use sightline::detection::{Polarity, Quality, Target};
use sightline::project::{Camera, Ignored, Interior, Observation, Photo, Sigma};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

fn package() -> Package {
    let project = Project {
        name: "Zweibrücken".into(),
        photos: vec![Photo {
            id: "1".into(),
            camera: "c".into(),
            position: Some([0.1, 1.0 / 3.0, 1e-300]),
            enabled: true,
            ..Photo::default()
        }]
        .into(),
        ..Project::default()
    };
    let targets =
        BTreeMap::from([("1".to_owned(), Detection { width: 3, height: 2, bits: 8, ..Detection::default() })]);
    Package { project, targets, photos: [("사진 1.jpg".to_owned(), vec![1, 2, 3])].into(), ..Package::default() }
}

/// A target without a number.
fn target(u: f64) -> Target {
    Target {
        id: 0,
        u,
        v: 1.0 / 3.0,
        sigma_u: 0.02,
        sigma_v: 0.03,
        covariance_uv: 0.0,
        major: 12.0,
        minor: 10.0,
        angle: 0.0,
        contrast: 100.0,
        polarity: Polarity::Bright,
        code: None,
        code_family: None,
        code_candidates: Vec::new(),
        inner: None,
        occluded: false,
        quality: Quality::default(),
    }
}

fn archive(entries: &[(&str, &[u8])]) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in entries {
        archive.start_file(*name, SimpleFileOptions::default()).unwrap();
        archive.write_all(bytes).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

#[test]
fn what_is_written_is_read_again_bit_for_bit() {
    let bytes = write(&package()).unwrap();
    assert_eq!(read(&bytes).unwrap(), package());
    assert_eq!(write(&read(&bytes).unwrap()).unwrap(), bytes);
    assert_eq!(read(&json(&package().project).unwrap()).unwrap().project, package().project);
}

#[test]
fn a_document_is_opened_in_every_encoding_and_by_both_ways() {
    let plain = format!("\r\n {}", String::from_utf8(json(&package().project).unwrap()).unwrap());
    let little: Vec<u8> = plain.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let big: Vec<u8> = plain.encode_utf16().flat_map(u16::to_be_bytes).collect();
    for bytes in [
        plain.as_bytes().to_vec(),
        [b"\xef\xbb\xbf", plain.as_bytes()].concat(),
        [b"\xff\xfe", little.as_slice()].concat(),
        [b"\xfe\xff", big.as_slice()].concat(),
        little,
        big,
    ] {
        let files = crate::Files::from([("p.json".to_owned(), bytes.clone())]);
        assert_eq!(read(&bytes).unwrap().project, package().project, "{:x?}", &bytes[..6]);
        assert_eq!(crate::import("sightline", &files).unwrap(), package().project);
    }
    let marked = [b"\xff\xfe", write(&package()).unwrap().as_slice()].concat();
    assert!(!is_json(&marked) && !is_json(b"\xef\xbb\xbf[") && !is_json(b""));
}

#[test]
fn targets_without_numbers_get_them_and_their_observations_too() {
    let mut old = package();
    let detection = old.targets.get_mut("1").unwrap();
    detection.targets = [3.25, 7.5, 9.0].map(target).into();
    let at = |point: &str, u: f64, target| Observation {
        photo: "1".into(),
        point: point.into(),
        u,
        v: 1.0 / 3.0,
        sigma: Sigma::One(0.1),
        enabled: true,
        target,
    };
    old.project.observations = vec![at("a", 7.5, None), at("by hand", 7.500001, None), at("lost", 1.0, Some(9))].into();
    let new = read(&write(&old).unwrap()).unwrap();
    assert_eq!(new.targets["1"].targets.iter().map(|t| t.id).collect::<Vec<_>>(), [1, 2, 3]);
    let numbers: Vec<_> = new.project.observations.iter().map(|o| o.target).collect();
    assert_eq!(numbers, [Some(2), None, None]);
    assert_eq!(read(&write(&new).unwrap()).unwrap(), new);
}

#[test]
fn damage_anywhere_is_an_error_or_harmless() {
    let bytes = write(&package()).unwrap();
    for cut in 0..bytes.len() {
        assert!(read(&bytes[..cut]).is_err(), "cut at {cut}");
    }
    for place in 0..bytes.len() {
        let mut bad = bytes.clone();
        bad[place] ^= 0x5a;
        // A changed time stamp is not noticed, a changed document is.
        if let Ok(read) = read(&bad) {
            assert_eq!(read.project, package().project, "byte {place}");
        }
    }
}

#[test]
fn foreign_archives_and_bombs_are_refused() {
    assert!(read(b"").is_err());
    assert!(read(b"GIF89a").is_err());
    let detail = |bytes: &[u8]| read(bytes).unwrap_err().to_string();
    assert!(detail(&archive(&[("word/document.xml", b"<x/>")])).contains("no project.json"));
    assert!(detail(&archive(&[("project.json", b"{\"format\": \"other\"}")])).contains("not a Sightline document"));
    assert!(
        detail(&archive(&[("project.json", b"{\"format\": \"sightline\", \"version\": 2}")])).contains("version 2")
    );
    let document = json(&package().project).unwrap();
    let odd = archive(&[
        ("project.json", &document),
        ("photos/../../etc/passwd", b"x"),
        ("photos/a/b.jpg", b"x"),
        ("/photos/c.jpg", b"x"),
    ]);
    assert!(read(&odd).unwrap().photos.is_empty());
    let path = Package { photos: [("../a.jpg".to_owned(), vec![])].into(), ..package() };
    assert!(write(&path).is_err());
}

#[test]
fn an_archive_with_two_entries_of_one_name_is_refused() {
    let document = json(&package().project).unwrap();
    // Written under names of the same length, and renamed in the bytes.
    for (first, second) in [("project.json", "projecu.json"), ("targets.json", "targett.json")] {
        let targets: &[u8] = b"{}";
        let mut bytes = match first {
            "project.json" => archive(&[(first, &document), (second, &document)]),
            _ => archive(&[("project.json", &document), (first, targets), (second, targets)]),
        };
        assert!(read(&bytes).is_ok(), "{first}");
        for at in 0..bytes.len() - second.len() {
            if bytes[at..].starts_with(second.as_bytes()) {
                bytes[at..at + first.len()].copy_from_slice(first.as_bytes());
            }
        }
        assert!(read(&bytes).unwrap_err().to_string().contains("same name"), "{first}");
    }
}

#[test]
fn a_damaged_part_costs_that_part() {
    let all = Package { adjustment: Some(Adjustment::default()), ..package() };
    let bytes = write(&all).unwrap();
    assert_eq!(read(&bytes).unwrap(), all);
    for (name, cost) in [
        ("adjustment.json", Package { adjustment: None, ..all.clone() }),
        ("targets.json", Package { targets: BTreeMap::new(), ..all.clone() }),
        ("photos/사진 1.jpg", Package { photos: BTreeMap::new(), ..all.clone() }),
    ] {
        let mut bad = bytes.clone();
        let header = bytes.windows(name.len()).position(|w| w == name.as_bytes()).expect("the entry");
        bad[header + name.len() + 1] ^= 0x11;
        let read = read(&bad).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(read.damaged.len(), 1, "{name}");
        assert_eq!(read.damaged[0].place().file.as_deref(), Some(name));
        assert_eq!(Package { damaged: Vec::new(), ..read }, cost);
    }
    let document = json(&all.project).unwrap();
    let wrong = archive(&[("project.json", &document), ("adjustment.json", b"{\"termination\": 3}")]);
    assert_eq!(read(&wrong).unwrap().damaged[0].place().file.as_deref(), Some("adjustment.json"));
}

/// Sets the size that entries claim in both of their headers.
fn claim(bytes: &mut [u8], name: &str, size: u32) {
    for (mark, size_at, name_at) in [(b"PK\x03\x04", 22, 30), (b"PK\x01\x02", 24, 46)] {
        for at in 0..bytes.len() - name_at {
            if bytes[at..].starts_with(mark) && bytes[at + name_at..].starts_with(name.as_bytes()) {
                bytes[at + size_at..at + size_at + 4].copy_from_slice(&size.to_le_bytes());
            }
        }
    }
}

#[test]
fn memory_is_bounded_by_what_the_headers_claim() {
    let document = json(&package().project).unwrap();
    let zeros = vec![0; 80 << 20];
    let bomb = archive(&[("project.json", &document), ("photos/a.jpg", &zeros)]);
    assert!(bomb.len() < 1 << 20);
    let error = read(&bomb).unwrap_err();
    assert!(error.to_string().contains("unpacks to more than"), "{error}");
    assert_eq!(error.place().file.as_deref(), Some("photos/a.jpg"));
    // it claims less than it is
    let mut liar = archive(&[("project.json", &document), ("photos/a.jpg", &zeros[..1 << 20])]);
    claim(&mut liar, "photos/a.jpg", 1000);
    let read_back = read(&liar).unwrap();
    assert!(read_back.photos.is_empty() && read_back.damaged.len() == 1);
    let mut large = archive(&[("project.json", &document)]);
    claim(&mut large, "project.json", 600 << 20);
    assert!(read(&large).unwrap_err().to_string().contains("512 MB"));
    let lists = format!("{{\"format\": \"sightline\", \"version\": 1, \"points\": [{}]}}", "[],".repeat(4 << 20));
    assert!(read(lists.as_bytes()).unwrap_err().to_string().contains("would take more than"));
}

#[test]
fn entries_that_share_bytes_are_refused() {
    let document = json(&package().project).unwrap();
    let mut bytes = archive(&[("project.json", &document), ("photos/a.jpg", &document), ("photos/b.jpg", &document)]);
    // the last entry of the directory points to the one before
    let headers = |bytes: &[u8], mark: &[u8; 4]| {
        (0..bytes.len() - 4).filter(|at| bytes[*at..].starts_with(mark)).collect::<Vec<_>>()
    };
    let (local, central) = (headers(&bytes, b"PK\x03\x04"), headers(&bytes, b"PK\x01\x02"));
    bytes[central[2] + 42..central[2] + 46].copy_from_slice(&(local[1] as u32).to_le_bytes());
    assert!(read(&bytes).is_err());
}

/// Where each entry stands, its name and its bytes, by the headers before them.
fn places(bytes: &[u8], names: &[&str]) -> Vec<(String, std::ops::Range<usize>)> {
    let starts = (0..bytes.len() - 4).filter(|at| bytes[*at..].starts_with(b"PK\x03\x04")).collect::<Vec<_>>();
    let directory = bytes.windows(4).position(|w| w == b"PK\x01\x02").expect("a directory");
    assert_eq!(starts.len(), names.len());
    let ends = starts[1..].iter().copied().chain([directory]);
    names.iter().zip(starts.iter().zip(ends)).map(|(name, (from, to))| ((*name).to_owned(), *from..to)).collect()
}

#[test]
fn damage_of_an_entry_is_told_of_that_entry_and_costs_no_other() {
    let all = Package {
        adjustment: Some(Adjustment::default()),
        photos: [("a.jpg".to_owned(), vec![7; 300]), ("b.jpg".to_owned(), (0..=255).collect())].into(),
        ..package()
    };
    let bytes = write(&all).unwrap();
    let names = ["project.json", "targets.json", "adjustment.json", "photos/a.jpg", "photos/b.jpg"];
    for (name, range) in places(&bytes, &names) {
        for (place, flip) in range.flat_map(|place| [0x01, 0x5a, 0x80].map(|flip| (place, flip))) {
            let mut bad = bytes.clone();
            bad[place] ^= flip;
            match read(&bad) {
                Err(error) => {
                    assert_eq!(name, "project.json", "byte {place}: {error}");
                    assert_eq!(error.place().file.as_deref(), Some("project.json"), "byte {place}: {error}");
                }
                Ok(read) => {
                    let told = read.damaged.iter().map(|error| error.place().file.clone()).collect::<Vec<_>>();
                    assert!(told.iter().all(|file| file.as_deref() == Some(&name)), "byte {place} of {name}: {told:?}");
                    let lost = |this: &str| name == this && !told.is_empty();
                    let mut cost = all.clone();
                    if lost("targets.json") {
                        cost.targets.clear();
                    }
                    cost.adjustment = cost.adjustment.filter(|_| !lost("adjustment.json"));
                    cost.photos.retain(|photo, _| !lost(&format!("photos/{photo}")));
                    assert_eq!(Package { damaged: Vec::new(), ..read }, cost, "byte {place} of {name}");
                }
            }
        }
    }
}

#[test]
fn photos_go_by_and_are_found_again() {
    let all = Package {
        photos: [("a.jpg", 0), ("b.jpg", 3 << 20), ("c.jpg", 1), ("d.jpg", 0)]
            .map(|(name, size)| (name.to_owned(), (0..size).map(|k: u32| (k % 251) as u8).collect()))
            .into(),
        ..package()
    };
    let mut photos = all.photos.iter().map(|(name, bytes)| (name.as_str(), &bytes[..])).collect::<Vec<_>>();
    let pieces = write_around(&all, &mut photos).unwrap();
    assert_eq!(pieces.len(), 5);
    assert!(pieces.iter().map(Vec::len).sum::<usize>() < 10_000);
    let bytes = write(&all).unwrap();
    let (read_back, held) = read_from(Cursor::new(&bytes)).unwrap();
    assert_eq!(read_back, Package { photos: BTreeMap::new(), ..all.clone() });
    for (name, held) in held {
        let Held::At(start, size) = held else { panic!("{name} is stored as it is") };
        assert_eq!(bytes[start as usize..][..size as usize], all.photos[&name]);
    }
}

#[test]
fn a_photo_that_cannot_be_read_is_named() {
    struct Gone;
    impl Read for Gone {
        fn read(&mut self, _: &mut [u8]) -> std::io::Result<usize> {
            Err(std::io::Error::other("unplugged"))
        }
    }
    let error = write_around(&package(), &mut [("a.jpg", Gone)]).unwrap_err();
    assert_eq!(error.place().file.as_deref(), Some("a.jpg"));
    assert!(error.to_string().contains("unplugged"), "{error}");
}

/// A file of a version that corrected lateral colour: it opens without, and without the result that was computed with it.
#[test]
fn lateral_colour_of_an_earlier_version_is_named_and_its_result_is_not_the_projects() {
    let text = |project: Project| String::from_utf8(json(&project).unwrap()).unwrap();
    let camera = Camera::new("c", 10, 20, Interior::brown(30.0));
    let adjusted = AdjustedCamera {
        camera: camera.clone(),
        photo: None,
        sigma: BTreeMap::new(),
        significance: BTreeMap::new(),
        correlation: Correlation::default(),
    };
    let project = Project { cameras: vec![camera], ..package().project };
    let adjustment = json(&Adjustment { cameras: vec![adjusted], ..Adjustment::default() }).unwrap();
    let earlier = |text: &str| text.replacen(r#""free":"#, r#""colours":{"red":{"parameters":{"c":0.1}}},"free":"#, 1);
    let whole = |project: &str, adjustment: &str| {
        let entries = [(DOCUMENT, project.as_bytes()), ("adjustment.json", adjustment.as_bytes())];
        read(&archive(&entries)).unwrap()
    };
    let (project, adjustment) = (text(project), String::from_utf8(adjustment).unwrap());
    let same = whole(&project, &adjustment);
    assert!(same.adjustment.is_some() && same.project.origin.is_none() && same.damaged.is_empty());
    let read = whole(&earlier(&project), &earlier(&adjustment));
    assert!(read.adjustment.is_none() && read.damaged.is_empty());
    let origin = read.project.origin.expect("an origin");
    assert_eq!(origin.ignored, [Ignored { name: RemovedFields::OF_CAMERAS.into(), count: 1 }]);
}
