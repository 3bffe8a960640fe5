//! 처음 한 시간의 글: 시작 페이지, 파일 메뉴, 아직 비어 있는 페이지, 판정.

use super::{Korean, choose};
use crate::i18n::translate;

translate! { Korean first {
    purpose: "사진에서 3차원 좌표와 표준오차를 구합니다";
    drop_photos: "사진을 이 페이지 아무 곳에나 놓으면 새 프로젝트가 시작됩니다. 프로젝트 파일을 열 수도 있습니다. 파일은 이 컴퓨터를 떠나지 않습니다.";
    picture: "여러 곳에서 찍은 표적 사진으로 표적의 좌표와 카메라 위치를 구합니다";
    new_project: "새 프로젝트";
    project: "프로젝트";
    file: "파일";
    without_photos: "사진 없이 시작하기";
    papers: "발표된 논문의 예제";
    no_photos: "아직 사진이 없습니다";
    drop_here: "한 대상물을 찍은 사진을 이 페이지 아무 곳에나 놓거나 고르십시오. 세 곳 이상에서 카메라를 돌려 가며 수렴 촬영한 사진이 가장 좋은 결과를 줍니다.";
    detection_options: "검출 설정";
    placing_on: "자유 지정 중: 누른 위치를 그대로 씁니다. Esc로 끝냅니다.";
    no_codes(targets): "이름 있는 점이 없습니다. 표적 {targets}개에서 코드를 찾지 못했습니다. 사진 세 매 이상에서 표적을 눌러 이름을 붙이십시오. 표정 후에는 ‘정합’이 나머지 이름을 붙입니다.";
    no_targets: "아직 표적이 없습니다. 먼저 사진에서 표적을 검출하십시오.";
    no_observations: "아직 조정할 것이 없습니다. 사진 두 매 이상에서 이름이 붙은 표적이 없습니다.";
    name_points: "점 이름 붙이기";
    verdict_passed(sigma0): "잔차가 주어진 표준오차와 일치합니다(σ₀ {sigma0}). 다음: 경고를 확인한 뒤 보고서를 작성하십시오.";
    verdict_contradicted(cause): "사진들은 서로 맞지만 주어진 값과 맞지 않습니다: {cause}.";
    cause_given(kind, name): "{kind} {name}{name:이|가} 맞지 않음";
    verdict_failed(sigma0, cause): "전체 모형 검정에 실패했습니다. 잔차가 표준오차의 {sigma0}배입니다. 가장 유력한 원인: {cause}.";
    verdict_too_large(sigma0): "전체 모형 검정에 실패했습니다. 잔차가 표준오차의 {sigma0}배에 그칩니다. 표준오차가 너무 크게 주어졌으므로 더 작게 주거나 잔차로 추정하십시오.";
    verdict_estimated: "표준오차를 잔차로 추정했으므로 전체 모형 검정이 없습니다. 다음: 경고를 확인한 뒤 보고서를 작성하십시오.";
    verdict_no_redundancy: "미지수와 관측값의 수가 같아 이 결과를 점검할 수 없습니다. 더 많은 사진에서 더 많은 점을 측정하거나 기준점을 주십시오.";
    verdict: "판정";
    figures: "결과의 수치";
    control_point: "기준점";
    cause_gross_errors(n, point, photo): "과대오차가 있는 관측 {n}개, 가장 큰 것은 사진 {photo}의 점 {point}";
    cause_model(camera): "카메라 {camera}의 왜곡을 알지 못하고 추정하지도 않음";
    cause_image_sigma: "사진좌표의 정확도가 주어진 표준오차보다 낮음";
    look_at_it: "보기";
    estimate_distortion: "매개변수 선택";
    change_weights: "경중률 변경";
    warnings(n): "경고 {n}개";
    photos_not_oriented(n, photos): "사진 {n}매를 표정하지 못했습니다: {photos}";
    points_not_determined(n, points): "점 {n}개의 좌표를 정하지 못했습니다: {points}";
    insignificant(names, camera): "카메라 {camera}의 {names}{names:은|는} 0과 유의하게 다르지 않습니다";
    insignificant_body(name): "서로 상관이 있으므로 먼저 {name}{name:을|를} 고정하고 다시 조정하십시오. 90° 회전 촬영과 거리가 다른 촬영을 추가하면 결정됩니다.";
    correlations(n, camera): "카메라 {camera}의 매개변수 {n}쌍의 상관이 매우 높습니다";
    correlations_body(pairs): "{pairs}. 좌표에는 영향이 작습니다. 90° 회전 촬영과 거리가 다른 촬영을 추가하면 분리됩니다.";
    match_targets: "정합";
    match_how: "표정된 사진에서의 예측 위치로 표적에 이름을 붙이고 조정하며, 더 추가되지 않을 때까지 되풀이합니다";
    matched_all(found, doubtful, rounds): "관측 {found}개를 {rounds}회에 걸쳐 정합하고 조정했습니다. 의심스러운 표적 {doubtful}개는 이름 없이 두었습니다.";
    match_nothing(doubtful): "정합할 것이 없습니다. 이름을 붙일 수 있는 표적에는 모두 이름이 있습니다. 의심스러운 표적 {doubtful}개.";
    match_stopped(rounds): "{rounds}회 후에도 관측이 계속 추가되어 멈추었습니다. 결과를 쓰기 전에 새로 정합된 점을 확인하십시오.";
}}
