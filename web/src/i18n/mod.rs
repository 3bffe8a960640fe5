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

/// Whether a number, as it is shown, is one.
pub(crate) fn is_one(count: &impl std::fmt::Display) -> bool {
    count.to_string() == "1"
}

/// Declares texts: `name: "English", "Korean";` or, with values, `name(a, b): "English {a} {b}", "Korean {b} {a}";`. What
/// English words become of a count stands before it: `name(n) [point = n "point" "points"]: "{n} {point}", "{n}점";`.
macro_rules! texts {
    ($($name:ident $(($($value:ident),+))? $([$($word:ident = $count:ident $one:literal $many:literal),+])? : $english:literal, $korean:literal;)+) => {
        $($crate::i18n::texts!(@one $name $(($($value),+))? $([$($word = $count $one $many),+])? $english, $korean);)+
    };
    (@one $name:ident $english:literal, $korean:literal) => {
        pub fn $name() -> &'static str {
            match $crate::i18n::language() {
                $crate::i18n::Language::English => $english,
                $crate::i18n::Language::Korean => $korean,
            }
        }
    };
    (@one $name:ident ($($value:ident),+) $([$($word:ident = $count:ident $one:literal $many:literal),+])? $english:literal, $korean:literal) => {
        pub fn $name($($value: impl std::fmt::Display),+) -> String {
            match $crate::i18n::language() {
                $crate::i18n::Language::English => {
                    $($(let $word = if $crate::i18n::is_one(&$count) { $one } else { $many };)+)?
                    format!($english)
                }
                $crate::i18n::Language::Korean => format!($korean),
            }
        }
    };
}
pub(crate) use texts;

#[cfg(test)]
mod tests {
    use super::text;

    #[test]
    fn one_is_no_plural() {
        assert_eq!(text::n_points(1), "1 point");
        assert_eq!(text::n_points(21), "21 points");
        let told = text::photos_sentence(1, 2);
        assert!(told.starts_with("1 photo, 2 cameras. Photos"), "{told}");
    }
}
