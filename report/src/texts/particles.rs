//! Korean particles, chosen by how the word before them is read aloud: 점 11을, 사진 4를, 카메라 Sony로.
//!
//! Standard Korean orthography (한글 맞춤법, 조사): 을, 은, 이, 과, 으로 after a final consonant, 를, 는, 가, 와, 로 after a
//! vowel, and 로 after a final ㄹ too.

/// How a word ends when it is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Ending {
    Vowel,
    Rieul,
    Consonant,
}

/// Of two particles the one that follows `word`: `closed` after a final consonant, `open` after a vowel.
pub fn after<'a>(word: &str, closed: &'a str, open: &'a str) -> &'a str {
    match ending(word) {
        Ending::Vowel => open,
        // 서울로, but 서울을.
        Ending::Rieul if closed.starts_with('으') => open,
        Ending::Rieul | Ending::Consonant => closed,
    }
}

fn ending(word: &str) -> Ending {
    let letters: Vec<char> = word.chars().map(plain).filter(|c| c.is_alphanumeric() || is_unit(*c)).collect();
    let Some(&last) = letters.last() else { return Ending::Vowel };
    match last {
        '가'..='힣' => match (last as u32 - '가' as u32) % 28 {
            0 => Ending::Vowel,
            8 => Ending::Rieul,
            _ => Ending::Consonant,
        },
        '0'..='9' => digits(&letters),
        // 마이크로미터, 밀리미터, 퍼센트, 도
        '%' | '°' => Ending::Vowel,
        'a'..='z' | 'A'..='Z' => latin(&letters),
        // Greek letters are read by their Korean names: 뮤, 파이; these end in a consonant: 엡실론, 오미크론, 입실론.
        'ε' | 'ο' | 'υ' | 'Ε' | 'Ο' | 'Υ' => Ending::Consonant,
        _ => Ending::Vowel,
    }
}

fn is_unit(c: char) -> bool {
    matches!(c, '%' | '°')
}

/// Subscripts are read as the digits they are.
fn plain(c: char) -> char {
    match c {
        '₀'..='₉' => char::from(b'0' + (c as u32 - '₀' as u32) as u8),
        '⁰' | '⁴'..='⁹' => char::from(b'0' + (c as u32 - '⁰' as u32) as u8),
        '¹' => '1',
        '²' => '2',
        '³' => '3',
        _ => c,
    }
}

/// 영 일 이 삼 사 오 육 칠 팔 구; zeros at the end of a number are 십, 백, 천, 만, 억, and alone 영: all close, but 조 does not.
fn digits(letters: &[char]) -> Ending {
    let zeros = letters.iter().rev().take_while(|c| **c == '0').count();
    match letters[letters.len() - 1] {
        '0' if zeros < letters.len() && (12..16).contains(&zeros) => Ending::Vowel,
        '0' | '3' | '6' => Ending::Consonant,
        '1' | '7' | '8' => Ending::Rieul,
        _ => Ending::Vowel,
    }
}

/// Abbreviations are read letter by letter (엘, 엠, 엔, 아르), words as they are written in Korean: 맵, 데스크, 카메라.
fn latin(letters: &[char]) -> Ending {
    let word: Vec<char> =
        letters.iter().rev().take_while(|c| c.is_ascii_alphabetic()).map(char::to_ascii_lowercase).collect();
    let text: String = word.iter().rev().collect();
    let capitals = letters.iter().rev().take(word.len()).all(char::is_ascii_uppercase);
    match text.as_str() {
        // Units: 픽셀; 밀리미터, 센티미터, 미터.
        "px" => return Ending::Rieul,
        "mm" | "cm" | "m" | "um" | "km" if !capitals => return Ending::Vowel,
        _ => {}
    }
    let vowel = |c: Option<&char>| c.is_some_and(|c| matches!(c, 'a' | 'e' | 'i' | 'o' | 'u' | 'y'));
    let spelled = word.len() == 1 || capitals || !word.iter().any(|c| vowel(Some(c)));
    match word[0] {
        'l' => Ending::Rieul,
        'm' | 'n' => Ending::Consonant,
        // 아르: the letter ends in a vowel; so do words in -r (카메라, 센서).
        _ if spelled => Ending::Vowel,
        'g' if word.get(1) == Some(&'n') => Ending::Consonant,
        // A short vowel before closes: 맵, 세트 is read 셋 in compounds, 록, 웹.
        'p' | 'k' | 'b' | 't' if vowel(word.get(1)) && !vowel(word.get(2)) => Ending::Consonant,
        'c' if vowel(word.get(1)) => Ending::Consonant,
        'k' if word.get(1) == Some(&'c') => Ending::Consonant,
        _ => Ending::Vowel,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn particles_follow_the_reading() {
        let object = |word: &str| after(word, "을", "를");
        let towards = |word: &str| after(word, "으로", "로");
        for word in
            ["사진", "점 10", "13", "6", "100", "9000", "L", "M", "px", "K₁", "x₀", "σ₀", "\"정합\"", "(3)", "map"]
        {
            assert_eq!(object(word), "을", "{word}");
        }
        for word in
            ["카메라", "12", "4", "5", "9", "c", "P₂", "mm", "µ", "sensor", "Sony", "DSC", "90 %", "15°", "", "C4040Z"]
        {
            assert_eq!(object(word), "를", "{word}");
        }
        for (word, wanted) in [("11", "로"), ("7", "로"), ("13", "으로"), ("2", "로"), ("L", "로"), ("N", "으로")]
        {
            assert_eq!(towards(word), wanted, "{word}");
        }
        assert_eq!(after("8", "과", "와"), "과");
        assert_eq!(after("1000000000000", "이", "가"), "가");
        assert_eq!(after("0", "은", "는"), "은");
    }
}
