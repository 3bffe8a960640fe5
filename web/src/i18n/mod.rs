//! Every word of the desk in every language: a text is a function, so that a missing translation does not compile.
//!
//! Used in a view, a text follows the language switch by itself, for it reads the language signal.

pub mod errors;
pub mod experiments;
mod reasons;
pub mod text;
mod weights;

use leptos::prelude::*;

use crate::browser::page;

/// The desk's languages.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Language {
    #[default]
    English,
    Korean,
}

thread_local! {
    static LANGUAGE: ArcRwSignal<Language> = ArcRwSignal::new(Language::default());
}

impl Language {
    pub fn tag(self) -> &'static str {
        match self {
            Self::English => "en",
            Self::Korean => "ko",
        }
    }

    fn from_tag(tag: &str) -> Self {
        if tag.starts_with("ko") { Self::Korean } else { Self::English }
    }

    pub fn other(self) -> Self {
        match self {
            Self::English => Self::Korean,
            Self::Korean => Self::English,
        }
    }
}

/// A text of the desk.
pub type Text = fn() -> &'static str;

/// The language in use.
pub fn language() -> Language {
    LANGUAGE.with(Get::get)
}

/// Switches the language; nothing else changes.
pub fn set_language(language: Language) {
    page::set_root_attribute("lang", language.tag());
    page::set_preference("language", language.tag());
    LANGUAGE.with(|l| l.set(language));
}

/// Takes the language chosen last, or the browser's.
pub fn restore_language() {
    let tag = page::preference("language").unwrap_or_else(page::preferred_language);
    set_language(Language::from_tag(&tag));
}

/// Words that follow a number in the English texts, in the plural and for one; longer ones first.
const COUNTED: [(&str, &str); 11] = [
    ("more measurements disagree", "more measurement disagrees"),
    ("observations exceed", "observation exceeds"),
    ("observations are", "observation is"),
    ("oriented photos", "oriented photo"),
    ("control points", "control point"),
    ("observations", "observation"),
    ("cameras", "camera"),
    ("targets", "target"),
    ("photos", "photo"),
    ("points", "point"),
    ("marks", "mark"),
];

/// An English sentence with "1 photos" put right.
pub(crate) fn singular(text: String) -> String {
    let mut rest = text.as_str();
    let mut corrected = String::with_capacity(text.len());
    while let Some(at) = rest.find("1 ") {
        let counts_one = !rest[..at].ends_with(|c: char| c.is_ascii_digit() || ",.-#".contains(c) || c.is_alphabetic());
        corrected.push_str(&rest[..at + 2]);
        rest = &rest[at + 2..];
        let Some((plural, one)) = COUNTED.iter().find(|(plural, _)| counts_one && rest.starts_with(plural)) else {
            continue;
        };
        corrected.push_str(one);
        rest = &rest[plural.len()..];
    }
    corrected + rest
}

/// Declares texts: `name: "English", "Korean";` or, with values, `name(a, b): "English {a} {b}", "Korean {b} {a}";`.
macro_rules! texts {
    ($($name:ident $(($($value:ident),+))? : $english:literal, $korean:literal;)+) => {
        $($crate::i18n::texts!(@one $name $(($($value),+))? $english, $korean);)+
    };
    (@one $name:ident $english:literal, $korean:literal) => {
        pub fn $name() -> &'static str {
            match $crate::i18n::language() {
                $crate::i18n::Language::English => $english,
                $crate::i18n::Language::Korean => $korean,
            }
        }
    };
    (@one $name:ident ($($value:ident),+) $english:literal, $korean:literal) => {
        pub fn $name($($value: impl std::fmt::Display),+) -> String {
            match $crate::i18n::language() {
                $crate::i18n::Language::English => $crate::i18n::singular(format!($english)),
                $crate::i18n::Language::Korean => format!($korean),
            }
        }
    };
}
pub(crate) use texts;

#[cfg(test)]
mod tests {
    use super::singular;

    #[test]
    fn one_is_no_plural() {
        let told = |text: &str| singular(text.to_owned());
        assert_eq!(told("1 photos, 1 cameras. Photos"), "1 photo, 1 camera. Photos");
        assert_eq!(told("21 photos, 0.1 points, A1 targets"), "21 photos, 0.1 points, A1 targets");
        assert_eq!(told("1 observations exceed; 11 observations"), "1 observation exceeds; 11 observations");
        assert_eq!(told("1 observations are, 2 observations are"), "1 observation is, 2 observations are");
    }
}
