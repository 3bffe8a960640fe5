//! Default name of a project: from its photos' files, from their camera and day, or from the day alone.

use std::collections::BTreeSet;

use sightline::exif::PhotoInfo;

/// Prefixes of file names from cameras and phones: they do not describe the object.
const OF_CAMERAS: [&str; 20] = [
    "dsc",
    "dscn",
    "dscf",
    "img",
    "image",
    "pict",
    "pic",
    "pxl",
    "gopr",
    "dji",
    "sam",
    "mvi",
    "photo",
    "foto",
    "scan",
    "imag",
    "cimg",
    "kakaotalk",
    "screenshot",
    "capture",
];
/// Letters that a common beginning needs: with fewer it is a counter's prefix.
const LEAST_LETTERS: usize = 3;

/// The name for a project with these photos; `today` is the day as `YYYY-MM-DD`, and `project` the word for one.
pub fn project_name(photos: &[(&str, &PhotoInfo)], today: &str, project: &str) -> String {
    let day = photos.iter().filter_map(|(_, info)| info.date.as_deref()?.get(..10)).min().unwrap_or(today);
    let names = photos.iter().map(|(name, _)| *name).collect::<Vec<_>>();
    if let Some(name) = common_name(&names) {
        return name;
    }
    let models = photos.iter().map(|(_, info)| info.model.as_deref().map(str::trim)).collect::<BTreeSet<_>>();
    match models.first() {
        Some(Some(model)) if models.len() == 1 && !model.is_empty() => format!("{model}, {day}"),
        _ => format!("{project} {day}"),
    }
}

/// Common prefix of the names of several files, without their counter; `None` if there is no useful one.
fn common_name(files: &[&str]) -> Option<String> {
    let stem = |file: &&str| file.rsplit_once('.').map_or(*file, |(stem, _)| stem).chars().collect::<Vec<_>>();
    let mut stems = files.iter().map(stem);
    let first = stems.next()?;
    // With a single photo, name and counter cannot be separated.
    let length =
        stems.next().map(|second| std::iter::once(second).chain(stems).map(|other| shared(&first, &other)).min())??;
    let common = first[..length].iter().collect::<String>();
    let counter = common.trim_end_matches(|c: char| c.is_ascii_digit());
    let name = counter.trim_end_matches(|c: char| !c.is_alphanumeric());
    let letters = name.chars().filter(|c| c.is_alphabetic()).collect::<String>().to_lowercase();
    let says = letters.chars().count() >= LEAST_LETTERS && !OF_CAMERAS.contains(&letters.as_str());
    says.then(|| name.to_owned())
}

fn shared(a: &[char], b: &[char]) -> usize {
    a.iter().zip(b).take_while(|(a, b)| a == b).count()
}

/// A name that is not in use yet: with a number behind it where it is.
pub fn apart_from(name: String, taken: &[String]) -> String {
    let mut apart = name.clone();
    let mut count = 1;
    while taken.contains(&apart) {
        count += 1;
        apart = format!("{name} ({count})");
    }
    apart
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(files: &[&str], info: &PhotoInfo) -> String {
        let photos = files.iter().map(|file| (*file, info)).collect::<Vec<_>>();
        project_name(&photos, "2026-11-28", "Project")
    }

    #[test]
    fn files_that_were_named_name_the_project_and_counters_do_not() {
        let none = PhotoInfo::default();
        let camera = PhotoInfo {
            model: Some("NIKON D3".into()),
            date: Some("2024-05-06T10:00:00".into()),
            ..PhotoInfo::default()
        };
        assert_eq!(named(&["panel-043_01.jpg", "panel-043_02.jpg"], &none), "panel-043");
        assert_eq!(named(&["Bridge bearing B 1.tif", "Bridge bearing B 2.tif"], &camera), "Bridge bearing B");
        assert_eq!(named(&["DSC_0001.JPG", "DSC_0002.JPG"], &camera), "NIKON D3, 2024-05-06");
        assert_eq!(named(&["IMG_0001.JPG", "IMG_0002.JPG"], &none), "Project 2026-11-28");
        assert_eq!(named(&["P1000001.JPG"], &camera), "NIKON D3, 2024-05-06");
        assert_eq!(named(&["a.jpg", "b.jpg"], &none), "Project 2026-11-28");
        assert_eq!(named(&["패널1.jpg", "패널2.jpg", "패널13.jpg"], &none), "Project 2026-11-28");
        assert_eq!(named(&["교량받침1.jpg", "교량받침2.jpg"], &none), "교량받침");
    }

    #[test]
    fn two_cameras_name_nothing() {
        let of = |model: &str| PhotoInfo { model: Some(model.into()), ..PhotoInfo::default() };
        let (a, b) = (of("A"), of("B"));
        assert_eq!(project_name(&[("1.jpg", &a), ("2.jpg", &b)], "2026-11-28", "Project"), "Project 2026-11-28");
        let (a, none) = (of("A"), PhotoInfo::default());
        assert_eq!(project_name(&[("1.jpg", &a), ("2.jpg", &none)], "2026-11-28", "Project"), "Project 2026-11-28");
    }

    #[test]
    fn a_name_in_use_gets_a_number() {
        let taken = ["a".to_owned(), "a (2)".to_owned()];
        assert_eq!(apart_from("a".into(), &taken), "a (3)");
        assert_eq!(apart_from("b".into(), &taken), "b");
    }
}
