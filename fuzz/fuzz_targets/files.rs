//! Any bytes as a file that is read: project files, every foreign format, EXIF. Each must end in a result or an error, and what was
//! read as a project can be written again in every format or is refused.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sightline::exchange::{Files, comparator, encoding, export, import, package};
use sightline::exif;

/// Formats that are read, and names of a file that they look for.
const READ: [(&str, &str); 8] = [
    ("sightline", "a.json"),
    ("package", "a.sightline"),
    ("control-csv", "a.csv"),
    ("mark-points", "markpts.txt"),
    ("photomodeler", "a.txt"),
    ("aicon", "a.obc"),
    ("dbat", "a.xml"),
    ("comparator", "a.csv"),
];
const WRITTEN: [&str; 6] = ["sightline", "package", "control-csv", "mark-points", "csv", "tsv"];

fuzz_target!(|data: &[u8]| {
    let Some((choice, rest)) = data.split_first() else { return };
    let (format, name) = READ[usize::from(*choice) % READ.len()];
    // a second file where a zero byte parts them
    let mut parts = rest.splitn(2, |byte| *byte == 0);
    let mut files = Files::from([(name.to_owned(), parts.next().unwrap_or_default().to_vec())]);
    if let Some(second) = parts.next().filter(|_| *choice & 128 != 0) {
        files.insert(format!("b-{name}"), second.to_vec());
    } else {
        files.insert(name.to_owned(), rest.to_vec());
    }
    if let Ok(project) = import(format, &files) {
        for format in WRITTEN {
            let _ = export(format, &project, None);
        }
    }
    let _ = package::read(rest);
    let _ = exif::read(rest);
    let _ = encoding::text(rest);
    let _ = comparator::recognises(&files);
});
