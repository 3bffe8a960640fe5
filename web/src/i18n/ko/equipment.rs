//! 다른 프로젝트를 위해 보관하는 장비의 문장.

use super::{Korean, choose};
use crate::i18n::translate;

translate! { Korean equipment {
    equipment: "장비";
    equipment_words: "검정한 카메라와 인증된 축척 막대를 이 컴퓨터나 파일에 보관하여 다른 프로젝트에 씁니다.";
    sentence(cameras, calibrations, bars): "카메라 {cameras}대, 검정 {calibrations}건, 축척 막대 {bars}개.";
    import_file: "파일 가져오기";
    export_file: "파일로 저장";
    kept_cameras: "카메라";
    kept_bars: "축척 막대";
    no_cameras: "보관한 카메라가 없습니다. 카메라를 추정하여 조정한 뒤 아래에서 그 검정을 보관하십시오.";
    no_bars: "보관한 축척 막대가 없습니다. 인증서의 값을 입력하십시오. 두 끝이 코드 표적이고 사진 두 매에 보이면 막대의 거리를 자동으로 씁니다.";
    of_this_result: "지금 결과의 카메라";
    keep_calibration: "이 검정 보관";
    calibration_kept(camera): "{camera}의 검정을 이 컴퓨터에 보관했습니다.";
    calibrated_on(date): "{date} 검정";
    remove_camera(camera): "카메라 {camera} 삭제";
    remove_calibration(date): "{date} 검정 삭제";
    remove_bar(bar): "축척 막대 {bar} 삭제";
    removed: "장비에서 삭제했습니다.";
    put_back: "되돌리기";
    bar_name: "이름";
    certificate: "인증서";
    date: "날짜";
    date_hint: "2026-05-01";
    keep_bar: "막대 보관";
    not_kept: "이 브라우저의 저장소에 장비를 쓰지 못했습니다. 파일로 저장하십시오.";
    imported(file, cameras, calibrations, bars):
        "{file}: 새 카메라 {cameras}대, 검정 {calibrations}건, 축척 막대 {bars}개를 가져왔습니다.";
    known_camera(name, date): "보관한 카메라입니다: {name}, {date} 검정. 사용 방법";
    held: "고정";
    held_means: "모든 매개변수를 검정한 값으로 고정합니다.";
    observed: "관측값으로";
    observed_means: "매개변수마다 검정의 표준오차를 가진 관측값으로 둡니다.";
    free: "추정";
    free_means: "검정한 값에서 시작해 모두 추정합니다.";
    bars_seen(bars): "사진에 보이는 축척 막대: {bars}.";
    take_bars: "거리 추가";
    bars_taken(bars): "사진에 보이는 축척 막대의 거리를 추가했습니다: {bars}.";
    change_calibration(camera): "{camera} 검정 값 사용";
    change_bars(n): "축척 막대 거리 {n}개";
} }
