//! The texts of weights, gross errors and weak spots: English and Korean side by side.

use super::texts;

texts! {
    unmodelled: "not modelled, px", "모형화되지 않은 오차, px";
    unmodelled_why: "added in quadrature to every σ of the image: lens, flatness of targets, light", "렌즈, 표적 평탄도, 조명의 영향. 사진좌표의 각 σ에 제곱합으로 더합니다";
    target_diameter(unit): "target diameter, {unit}", "표적 지름, {unit}";
    target_diameter_why: "of all circular targets that state none of their own: frees their images of the eccentricity; empty for none", "지름이 따로 주어지지 않은 모든 원형 표적에 적용하여 편심을 보정합니다. 비워 두면 보정하지 않습니다";
    no_diameter(typed): "\"{typed}\" is no diameter: type a number above 0, or nothing.", "\"{typed}\" 은(는) 지름이 아닙니다. 0보다 큰 수를 입력하거나 비워 두십시오.";
    gross_errors: "Gross errors", "과대오차";
    gross_left: "Leave everything in", "모두 사용";
    gross_left_body: "Suspicious observations are named; you decide.", "의심되는 관측을 알려 주고, 판단은 사용자가 합니다.";
    gross_snooping: "Data snooping", "데이터 스누핑";
    gross_snooping_body: "The worst observation is taken out, one a round, and taken back where it fits after all.", "한 번에 가장 나쁜 관측 하나를 빼고, 나중에 맞으면 되돌립니다.";
    gross_huber: "Robust weights, Huber", "로버스트 가중값(Huber)";
    gross_huber_body: "Large residuals count less; nothing is taken out.", "큰 잔차의 가중값을 줄이고 관측은 빼지 않습니다.";
    gross_tukey: "Robust weights, Tukey", "로버스트 가중값(Tukey)";
    gross_tukey_body: "Beyond its limit a residual counts nothing.", "한계를 넘은 잔차는 영향을 주지 않습니다.";
    gross_record: "What was done about gross errors", "과대오차 처리 기록";
    gross_removed: "taken out", "제거";
    gross_restored: "taken back", "복원";
    gross_downweighted: "weighted down", "가중값 감소";
    gross_round: "round", "회차";
    gross_action: "action", "처리";
    gross_statistic: "τ or weight", "τ 또는 가중값";
    gross_limit: "limit", "한계";
    photo_or_kind: "photo or kind", "사진 또는 종류";
    gross_consequence: "along with it: one ray left", "함께 제거: 광선 하나만 남음";
    control_coordinate: "control coordinate", "기준점 좌표";
    projection_centre: "projection centre", "투영중심";
    distance: "distance", "거리";
    camera_parameter: "camera parameter", "카메라 매개변수";
    unmodelled_again: "What is not modelled can be told more closely now", "모형화되지 않은 오차를 이제 더 정확히 정할 수 있습니다";
    unmodelled_again_body: "The value was found with other weights; with these the residuals ask for this one.", "앞의 값은 다른 가중값에서 구한 것입니다. 지금 가중값의 잔차로는 이 값이 맞습니다.";
    add_unmodelled(px): "Take {px} px and adjust", "{px} px로 조정";
    correlated(first, second): "{first} and {second} are hardly told apart", "{first}와(과) {second}이(가) 거의 구분되지 않습니다";
    correlated_body(camera): "Camera {camera}: hold one of them, or add rolled photos and depth.", "카메라 {camera}: 하나를 고정하거나 회전 촬영과 깊이 변화를 더하십시오.";
    camera_against_photos(n) [photo = n "photo" "photos"]: "In {n} {photo} the camera is hardly told apart from their orientation", "사진 {n}매에서 카메라 매개변수와 외부표정요소가 거의 구분되지 않습니다";
    camera_against_photos_body(photos): "Correlations over 0.95. Coordinates suffer little as long as the camera is used as adjusted; rolled photos and depth would part them ({photos}).", "상관계수가 0.95를 넘습니다. 조정된 카메라를 그대로 쓰면 좌표에는 영향이 작으며, 회전 촬영과 깊이 변화로 분리됩니다({photos}).";
    low_redundancy(n) [observations = n "observation is" "observations are"]: "{n} {observations} hardly checked by others", "다른 관측으로 거의 점검되지 않는 관측 {n}개";
    low_redundancy_body(names): "Redundancy numbers below 0.1: an error there would stay unseen ({names}).", "여유수가 0.1 미만이어서 오차가 있어도 드러나지 않습니다({names}).";
    two_rays(points): "Measure in a third photo: {points}", "세 번째 사진에서 측정할 점: {points}";
    two_rays_body: "With two rays an error along the epipolar line stays unseen.", "광선이 둘이면 공액선 방향의 오차가 드러나지 않습니다.";
    narrow(points): "Rays meet under less than 5°: {points}", "광선 교차각이 5° 미만인 점: {points}";
    narrow_body: "The depth is weak: add a photo from the side.", "깊이가 약합니다. 옆에서 찍은 사진을 더하십시오.";
    behind_camera(names): "Points behind the camera that is said to see them: {names}", "촬영한 카메라 뒤에 놓인 점: {names}";
    behind_camera_body: "Check these names: the solution is turned inside out there.", "점번호를 확인하십시오. 해가 그곳에서 뒤집혀 있습니다.";
    distance_unused(names): "Distances left out: {names}", "쓰지 않은 거리: {names}";
    distance_unused_body: "An end of it is not measured in two photos.", "한쪽 끝이 두 사진에서 측정되지 않았습니다.";
    unsettled: "The search for gross errors came to no end", "과대오차 탐색이 끝나지 않았습니다";
    unsettled_body: "Too many observations contradict each other: look at names and control first.", "서로 어긋나는 관측이 너무 많습니다. 점번호와 기준점부터 확인하십시오.";
}
