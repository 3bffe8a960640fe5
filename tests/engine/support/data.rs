//! The data with independent answers, read where it lies: the folder of the variable SIGHTLINE_DATA, else
//! `../shared/data` beside the repository. Without the folder a test says so and passes; with it, every file must be there.

use std::io::Write;
use std::path::Path;

/// Bytes of a file below the data folder; `None`, said aloud, where there is no such folder.
///
/// # Panics
/// When the folder is there and the file is not: on a machine that has the data, nothing is skipped.
pub fn data(path: &str) -> Option<Vec<u8>> {
    let folder =
        variable("SIGHTLINE_DATA").unwrap_or_else(|| concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data").to_owned());
    if !Path::new(&folder).exists() {
        println!("skipped, no data ({path})");
        count_as_skipped();
        return None;
    }
    let file = format!("{folder}/{path}");
    Some(std::fs::read(&file).unwrap_or_else(|error| panic!("{file}: {error}")))
}

/// The same as text.
pub fn text(path: &str) -> Option<String> {
    data(path).map(|bytes| String::from_utf8(bytes).unwrap_or_else(|_| panic!("{path} is not UTF-8")))
}

/// Rust's harness knows no skipping at run time: `cargo xtask test` counts the names of tests in the file that the variable
/// SIGHTLINE_SKIPPED names.
pub fn count_as_skipped() {
    let Some(list) = variable("SIGHTLINE_SKIPPED") else { return };
    let name = std::thread::current().name().unwrap_or_default().to_owned();
    let file = std::fs::OpenOptions::new().create(true).append(true).open(&list);
    let written = file.and_then(|mut file| writeln!(file, "{name}"));
    written.unwrap_or_else(|error| panic!("{list}: {error}"));
}

fn variable(name: &str) -> Option<String> {
    std::env::var(name).ok().filter(|value| !value.is_empty())
}

mod tests {
    #[test]
    fn files_of_the_data_folder_are_read() {
        if let Some(marks) = super::text("camcal/markpts.txt") {
            assert_eq!(marks.lines().filter(|line| !line.starts_with('#')).count(), 2074);
        }
        if let Some(photo) = super::data("camcal/photos/P8250021.JPG") {
            assert_eq!(photo[..3], [0xff, 0xd8, 0xff]);
        }
    }
}
