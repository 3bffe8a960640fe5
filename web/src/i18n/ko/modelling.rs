//! 카메라 모형: 선택, 변환, 비교.

use super::{Korean, choose};
use crate::i18n::translate;

translate! { Korean modelling {
    camera_model: "카메라 모형";
    converting: "카메라 변환 중";
    converted(from, max, rms): "{from}에서 변환: 영상점 차이는 최대 {max} px(RMS {rms} px)입니다.";
    converted_part(percent): "영상의 {percent} %에서 성립합니다. 광축에서 더 먼 곳은 이 모형으로 나타낼 수 없습니다.";
    converted_unknown: "주점거리를 아직 모르므로 왜곡은 0에서 시작합니다.";
    dropped(parameters): "이 모형에는 {parameters}의 사전값을 둘 수 없습니다.";
    compare: "모형 비교";
    compare_why: "카메라 모형마다 망을 조정하여 어느 모형이 사진과 잘 맞는지 보입니다. 과대오차 처리는 먼저 끄십시오.";
    comparing: "카메라 모형 비교 중";
    parameters: "매개변수";
    held_out: "교차 검증";
    held_out_why: "사진좌표의 5분의 1을 빼고 조정하여 예측한 값과의 차이(RMS)입니다.";
    bic_why: "베이즈 정보 기준(Schwarz)에서 가장 나은 모형의 값을 뺀 것으로, 적합도와 매개변수 수를 함께 봅니다. 10을 넘으면 뚜렷합니다.";
    best: "사진과 가장 잘 맞음";
    as_good_with_fewer: "더 적은 매개변수로 똑같이 맞음";
    as_good: "똑같이 맞음";
    too_stiff: "덜 맞음: 이 렌즈를 그만큼 잘 나타내지 못함";
    overfits: "매개변수는 더 많으나 더 잘 맞지 않음";
    failed: "조정할 수 없음";
    not_told(parameters): "0과 유의하게 다르지 않음: {parameters}";
    in_use: "사용 중";
    take: "사용";
    compared_note: "모형을 바꾼 뒤에는 다시 조정하십시오.";
    change_model(camera, model): "카메라 {camera}의 모형을 {model}{model:으로|로} 변경";
} }
