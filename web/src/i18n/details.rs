//! What the engine says is wrong with a document or file, in Korean: its English sentence is recognised by its fixed
//! words, and the values between them are carried over. A sentence that is not listed stays as the engine wrote it.

/// English as the engine writes it, and Korean; `{}` stands for a value, in the same order in both unless numbered.
const SENTENCES: [(&str, &str); 74] = [
    // The document
    (
        "this is format \"{}\" version {}; \"sightline\" version 1 is read here",
        "형식 \"{}\" 버전 {}입니다. 여기서는 \"sightline\" 버전 1을 읽습니다",
    ),
    (
        "not a document of Sightline: \"format\": \"sightline\" is missing",
        "Sightline 문서가 아닙니다. \"format\": \"sightline\"이 없습니다",
    ),
    ("not a document of Sightline: {}", "Sightline 문서가 아닙니다: {}"),
    (
        "the document has version {} and this program reads version 1: open it with a newer one",
        "문서 버전이 {}입니다. 이 프로그램은 버전 1을 읽으므로 더 새로운 프로그램으로 여십시오",
    ),
    ("the document has no version", "문서에 버전이 없습니다"),
    ("the document is damaged: {}", "문서가 손상되었습니다: {}"),
    ("this format is one file, {} were given", "이 형식은 파일 하나입니다. {}개를 주었습니다"),
    (
        "the photo's own interior orientation must be of its camera's model",
        "사진별 내부표정은 카메라와 같은 모델이어야 합니다",
    ),
    ("a target's diameter is greater than 0", "표적 지름은 0보다 커야 합니다"),
    ("a target's normal is a direction: not all of it is 0", "표적의 법선은 방향이므로 세 성분이 모두 0일 수 없습니다"),
    (
        "the standard error of an image observation is greater than 0 pixels",
        "영상 관측값의 표준오차는 0화소보다 커야 합니다",
    ),
    ("a distance joins two different points", "거리는 서로 다른 두 점을 잇습니다"),
    ("a distance is greater than 0", "거리는 0보다 커야 합니다"),
    ("the standard error of a distance is greater than 0", "거리의 표준오차는 0보다 커야 합니다"),
    ("a number here is not finite or beyond all measure", "유한하지 않거나 터무니없이 큰 수가 있습니다"),
    ("a standard error is 0 (fixed) or greater", "표준오차는 0(고정) 이상이어야 합니다"),
    ("the principal distance is greater than 0", "주점거리는 0보다 커야 합니다"),
    ("a parameter is a finite number", "매개변수는 유한한 수여야 합니다"),
    ("width and height of the sensor grid are at least one pixel", "센서 격자의 폭과 높이는 1화소 이상이어야 합니다"),
    ("the pixel pitch is greater than 0 millimetres", "화소 간격은 0 mm보다 커야 합니다"),
    (
        "the a priori standard error of a parameter is greater than 0; leave it out to hold the parameter",
        "매개변수의 사전 표준오차는 0보다 커야 합니다. 고정하려면 비워 두십시오",
    ),
    (
        "f stands for fx and fy as one: estimate either f, or fx and fy",
        "f는 fx와 fy를 하나로 나타냅니다. f만, 또는 fx와 fy를 추정하십시오",
    ),
    // The adjustment
    (
        "the datum needs at least three points that do not lie in one line",
        "기준계에는 한 직선 위에 있지 않은 점이 셋 이상 필요합니다",
    ),
    (
        "the iteration ended where a point has no image: improve the initial values",
        "점의 상이 생기지 않는 곳에서 반복이 끝났습니다. 초기값을 개선하십시오",
    ),
    // Detection
    (
        "{} is {}; a place in the picture lies between 0 and {}",
        "{}이(가) {}입니다. 사진 안의 위치는 0부터 {}까지입니다",
    ),
    ("{} is {}; a positive number of pixels is expected", "{}이(가) {}입니다. 양의 화소 수여야 합니다"),
    ("min_diameter {} is larger than max_diameter {}", "최소 지름 {}이(가) 최대 지름 {}보다 큽니다"),
    // Texts and tables
    ("this is no text in UTF-8{}", "UTF-8 텍스트가 아닙니다. UTF-8 텍스트 파일로 저장하십시오"),
    ("{} is missing: the line has {} fields", "{}이(가) 없습니다. 이 행의 항목은 {}개입니다"),
    ("{} is missing", "{}이(가) 없습니다"),
    ("{} is no number: \"{}\"", "{}이(가) 수가 아닙니다: \"{}\""),
    ("{} is no whole number: \"{}\"", "{}이(가) 정수가 아닙니다: \"{}\""),
    ("{} is not positive: {}", "{}이(가) 양수가 아닙니다: {}"),
    ("{} is negative: {}", "{}이(가) 음수입니다: {}"),
    (
        "{} has a comma, and the other numbers a decimal point: \"{}\" (write it without thousands marks)",
        "{}: 다른 수는 소수점을 쓰는데 쉼표가 있습니다: \"{}\" (천 단위 구분 없이 쓰십시오)",
    ),
    (
        "{} has a point, and the other numbers a decimal comma: \"{}\" (write it without thousands marks)",
        "{}: 다른 수는 소수 쉼표를 쓰는데 점이 있습니다: \"{}\" (천 단위 구분 없이 쓰십시오)",
    ),
    (
        "role is control, check or tie, not \"{}\"",
        "역할은 control, check, tie 가운데 하나입니다. \"{}\"은(는) 아닙니다",
    ),
    (
        "a control point needs four columns (id, X, Y, Z) and the table has {}",
        "기준점에는 네 열(id, X, Y, Z)이 필요한데 표의 열은 {}개입니다",
    ),
    // The project file
    ("a photo's file name holds no folders", "사진 파일 이름에는 폴더를 넣을 수 없습니다"),
    (
        "the archive has {} entries; a project file has up to {}",
        "압축 파일의 항목이 {}개입니다. 프로젝트 파일은 {}개까지입니다",
    ),
    (
        "this archive is no project file: it holds no project.json",
        "프로젝트 파일이 아닙니다. 압축 안에 project.json이 없습니다",
    ),
    ("the project file is damaged: {}", "프로젝트 파일이 손상되었습니다: {}"),
    (
        "the archive unpacks to more than {} MB: it is no project file",
        "압축을 풀면 {} MB가 넘습니다. 프로젝트 파일이 아닙니다",
    ),
    (
        "not a project file, or a damaged one ({}): save it again from where it was made",
        "프로젝트 파일이 아니거나 손상되었습니다({}). 만든 곳에서 다시 저장하십시오",
    ),
    ("the project file cannot be written: {}", "프로젝트 파일을 쓸 수 없습니다: {}"),
    ("cannot be written as JSON: {}", "JSON으로 쓸 수 없습니다: {}"),
    // Other programs' files
    (
        "not a text export of PhotoModeler, or cut short: {} is missing",
        "PhotoModeler 텍스트 내보내기 파일이 아니거나 중간에 잘렸습니다: {} 없음",
    ),
    ("the picture has no pixels", "사진에 화소가 없습니다"),
    ("not a project of DBAT: document and input are missing", "DBAT 프로젝트가 아닙니다. document와 input이 없습니다"),
    ("the format has no column {}", "형식에 {} 열이 없습니다"),
    ("the columns of {} are not named", "{}의 열 이름이 없습니다"),
    ("{} is {} numbers, not \"{}\"", "{}은(는) 수 {}개여야 합니다: \"{}\""),
    ("{} needs a positive width and height", "{}의 폭과 높이는 양수여야 합니다"),
    (
        "lens model {} distorts the ideal point: only corrections of the measured point (models from 1) are read",
        "렌즈 모델 {}은(는) 이상점을 왜곡합니다. 측정점을 보정하는 모델(1부터)만 읽습니다",
    ),
    ("a skew is not read: only 0", "비직교(skew)는 0만 읽습니다"),
    (
        "there are {} cameras, and the photos do not say which is theirs",
        "카메라가 {}대인데 사진에 어느 카메라인지 적혀 있지 않습니다",
    ),
    ("a filter keeps or removes, not \"{}\"", "filter는 keep 또는 remove입니다: \"{}\""),
    ("the XML is damaged: {}", "XML이 손상되었습니다: {}"),
    // Film
    (
        "\"{}\" is no reading: photo, mark, x, y are expected",
        "\"{}\"은(는) 측정값이 아닙니다. 사진, 표지, x, y가 필요합니다",
    ),
    (
        "photo coordinates are in millimetres: give the camera a pixel pitch",
        "사진좌표는 밀리미터입니다. 카메라에 화소 간격을 주십시오",
    ),
    (
        "the standard error of a photo coordinate is a number of millimetres above 0",
        "사진좌표의 표준오차는 0보다 큰 밀리미터 값이어야 합니다",
    ),
    (
        "{} measured and {} given marks; at least {} pairs are needed",
        "측정한 지표 {}개, 주어진 지표 {}개입니다. 쌍이 {}개 이상 필요합니다",
    ),
    ("all fiducial marks lie in one point", "사진지표가 모두 한 점에 있습니다"),
    ("the fiducial marks lie on a line", "사진지표가 한 직선 위에 있습니다"),
    (
        "unmodelled is {}; a number of pixels from 0 is expected",
        "모형화되지 않은 오차가 {}입니다. 0 이상의 화소 수여야 합니다",
    ),
    (
        "target_diameter is {}; a finite number above 0 is expected",
        "표적 지름이 {}입니다. 0보다 큰 유한한 수여야 합니다",
    ),
    (
        "target_diameter is {}, but all points lie within {}; give it in their unit",
        "표적 지름이 {}인데 모든 점이 {} 안에 있습니다. 점 좌표와 같은 단위로 입력하십시오",
    ),
    ("{} radii and {} distortions do not determine {} terms", "반경 {}개와 왜곡량 {}개로는 {}개 항을 정할 수 없습니다"),
    (
        "radii and distortions are finite numbers, not all 0",
        "반경과 왜곡량은 유한한 수여야 하며 모두 0일 수는 없습니다",
    ),
    ("the radii do not determine {} terms", "이 반경들로는 {}개 항을 정할 수 없습니다"),
    // Experiments
    (
        "the standard deviation of image coordinates is from 0.01 to 1000 µm",
        "사진좌표의 표준편차는 0.01에서 1000 µm까지입니다",
    ),
    ("the noise of the pixels is a share from 0 to 0.2", "화소 잡음은 최댓값의 0에서 0.2까지입니다"),
    (
        "the standard error of control coordinates is from 1e-6 to 1000 mm",
        "기준점 좌표의 표준오차는 1e-6에서 1000 mm까지입니다",
    ),
    ("at most 100000 rounds of Monte Carlo", "몬테카를로 반복은 100000회까지입니다"),
];

/// The sentence in Korean, with its values; none where it is not listed.
pub fn korean(english: &str) -> Option<String> {
    SENTENCES.iter().find_map(|(pattern, korean)| {
        let values = values(pattern, english)?;
        let mut values = values.iter();
        let mut parts = korean.split("{}");
        let first = parts.next()?.to_owned();
        Some(parts.fold(first, |text, part| text + values.next().copied().unwrap_or_default() + part))
    })
}

/// What stands in the holes of a pattern, when the text is of that pattern.
fn values<'a>(pattern: &str, text: &'a str) -> Option<Vec<&'a str>> {
    let mut words = pattern.split("{}");
    let mut rest = text.strip_prefix(words.next()?)?;
    let mut values = Vec::new();
    let mut words = words.peekable();
    while let Some(word) = words.next() {
        let at = match words.peek() {
            None => rest.ends_with(word).then(|| rest.len() - word.len())?,
            Some(_) => rest.find(word)?,
        };
        values.push(&rest[..at]);
        rest = &rest[at + word.len()..];
    }
    rest.is_empty().then_some(values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_carried_over() {
        assert_eq!(korean("Y is no number: \"zwei\"").as_deref(), Some("Y이(가) 수가 아닙니다: \"zwei\""));
        assert_eq!(korean("the document has no version").as_deref(), Some("문서에 버전이 없습니다"));
        assert_eq!(korean("something new"), None);
        assert_eq!(values("a {} b {}", "a 1 b 2"), Some(vec!["1", "2"]));
        assert_eq!(values("a {} b", "a 1 c"), None);
        assert_eq!(values("plain", "plain and more"), None);
    }

    #[test]
    fn both_languages_hold_the_same_values() {
        for (english, korean) in SENTENCES {
            let holes = |text: &str| text.matches("{}").count();
            assert!(holes(korean) == holes(english) || english.ends_with("UTF-8{}"), "{english}");
        }
    }

    /// What users' files really provoke comes out in Korean.
    #[test]
    fn faults_of_files_are_translated() {
        let files =
            |name: &str, text: &str| sightline::exchange::Files::from([(name.to_owned(), text.as_bytes().to_vec())]);
        let cases = [
            ("control-csv", "1, 2, 3\n"),
            ("control-csv", "1, 2, zwei, 4\n"),
            ("control-csv", "id,X,Y,Z,sX\n1, 2, 3, 4, -1\n"),
            ("aicon", "1 2 3\n"),
            ("mark-points", "a, 1, 2, 3, 0\n"),
            ("sightline", "{}"),
            ("sightline", "{\"format\": \"sightline\", \"version\": 7}"),
            ("sightline", "{\"format\": \"sightline\", \"version\": 1, \"photos\": 3}"),
            ("package", "PK"),
            ("photomodeler", "nothing"),
            ("dbat", "<document></document>"),
            ("dbat", "<document>"),
        ];
        for (format, text) in cases {
            match sightline::exchange::import(format, &files("f.xml", text)) {
                Err(sightline::Error::Invalid { detail, .. }) => {
                    assert!(korean(&detail).is_some(), "{format}: {detail}")
                }
                other => panic!("{format} {text:?}: {other:?}"),
            }
        }
    }

    /// So does what an experiment refuses.
    #[test]
    fn refused_options_are_translated() {
        use sightline::experiments::{ExperimentOptions, run};
        let with = |change: fn(&mut ExperimentOptions)| {
            let mut options = ExperimentOptions::default();
            change(&mut options);
            run("kim", &options, &mut |_, _| true)
        };
        let refused = [
            with(|o| o.image_sigma_um = Some(-1.0)),
            with(|o| o.pixel_noise = Some(2.0)),
            with(|o| o.control_sigma_mm = Some(f64::NAN)),
            with(|o| o.rounds = Some(1_000_000)),
        ];
        for outcome in refused {
            match outcome {
                Err(sightline::Error::Invalid { detail, .. }) => assert!(korean(&detail).is_some(), "{detail}"),
                other => panic!("{:?}", other.err()),
            }
        }
    }
}
