//! Photos stored twice by a camera, as RAW and developed: one exposure, to be measured once.

use sightline::exif::PhotoInfo;

/// Endings of RAW files, all makers'.
const RAW: [&str; 19] = [
    "3fr", "arw", "cr2", "cr3", "crw", "dcr", "dng", "erf", "iiq", "kdc", "mrw", "nef", "nrw", "orf", "pef", "raf",
    "rw2", "srw", "x3f",
];

/// Whether a file is RAW, by its name.
pub fn is_raw(file: &str) -> bool {
    parts(file).1.is_some_and(|ending| RAW.contains(&ending.to_lowercase().as_str()))
}

/// Whether two files are one shot: of one name, one RAW and one not, and with the same time if both have one.
pub fn same_shot((file, info): (&str, &PhotoInfo), (other, other_info): (&str, &PhotoInfo)) -> bool {
    let name = |file| parts(file).0.to_lowercase();
    let agree = |a: &Option<String>, b: &Option<String>| a.is_none() || b.is_none() || a == b;
    is_raw(file) != is_raw(other)
        && name(file) == name(other)
        && agree(&info.date, &other_info.date)
        && agree(&info.model, &other_info.model)
}

/// Name and ending of a file, without its folders.
fn parts(file: &str) -> (&str, Option<&str>) {
    let file = file.rsplit(['/', '\\']).next().unwrap_or(file);
    file.rsplit_once('.').map_or((file, None), |(name, ending)| (name, Some(ending)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(date: &str) -> PhotoInfo {
        PhotoInfo { date: Some(date.into()), ..PhotoInfo::default() }
    }

    #[test]
    fn one_shot_has_one_name_and_one_time() {
        let (early, late, never) = (at("2026-02-03T04:05:06"), at("2026-02-03T04:05:09"), PhotoInfo::default());
        assert!(same_shot(("IMG_1.CR3", &early), ("img_1.jpg", &early)));
        assert!(same_shot(("a/IMG_1.JPG", &never), ("IMG_1.dng", &early)));
        assert!(!same_shot(("IMG_1.CR3", &early), ("IMG_1.JPG", &late)));
        assert!(!same_shot(("IMG_1.CR3", &early), ("IMG_2.JPG", &early)));
        assert!(!same_shot(("IMG_1.HEIC", &early), ("IMG_1.JPG", &early)));
        assert!(!same_shot(("IMG_1.CR3", &early), ("IMG_1.DNG", &early)));
        let named = |model: &str| PhotoInfo { model: Some(model.into()), ..at("2026-02-03T04:05:06") };
        assert!(!same_shot(("IMG_1.CR3", &named("R5")), ("IMG_1.JPG", &named("R6"))));
    }
}
