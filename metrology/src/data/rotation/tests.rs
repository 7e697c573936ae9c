//! Tests of `rotation.rs`.

use super::*;

#[test]
fn numbers_and_back() {
    let column = || super::super::column::Column { name: String::new(), span: None };
    let four = || Box::new([column(), column(), column(), column()]);
    let r = from_euler([2, 1, 0], [0.7, -0.4, 2.9]);
    let nine = Box::new(std::array::from_fn(|_| column()));
    let three = || Box::new(std::array::from_fn(|_| column()));
    let turns = [
        Turn::Quaternion(four(), Order::Wxyz),
        Turn::Quaternion(four(), Order::Xyzw),
        Turn::Matrix(nine),
        Turn::Euler(three(), [2, 1, 0], 1.0),
        Turn::Euler(three(), [0, 1, 2], 0.5),
        Turn::Euler(three(), [1, 2, 0], 1.0),
        Turn::Euler(three(), [2, 1, 2], 1.0),
        Turn::Euler(three(), [2, 0, 2], 1.0),
        Turn::Euler(three(), [0, 1, 0], 1.0),
        Turn::Euler(three(), [1, 0, 1], 1.0),
        Turn::RotationVector(three(), 0.5),
    ];
    for turn in turns {
        let back = from_numbers(&turn, &to_numbers(&turn, &r)).unwrap();
        for (a, b) in back.as_flattened().iter().zip(r.as_flattened()) {
            assert!((a - b).abs() < 1e-12, "{turn:?}");
        }
    }
    let numbers = to_numbers(&Turn::Euler(three(), [2, 1, 0], 1.0), &r);
    assert!((numbers[0] - 0.7).abs() < 1e-12 && (numbers[1] + 0.4).abs() < 1e-12);
}
