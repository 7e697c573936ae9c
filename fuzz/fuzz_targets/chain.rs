//! Random specs chosen by the fuzzer: the interpreter's real pose equals that of the exact chain.
#![no_main]

use abbe::{Manipulator, Pose, real_pose, repeatable_magnitudes};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_tests::abuse::{Choices, plain_spec};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let text = plain_spec(&mut Choices::of_bytes(bytes));
    let Ok(spec) = Spec::parse("fuzzed.toml", &text) else { return };
    let interpreter = Interpreter::new(spec);
    let description = interpreter.description();
    let q: Vec<f64> = description.variables.iter().map(|variable| variable.home).collect();
    let s: Vec<f64> = description.parameters.iter().map(|parameter| parameter.nominal).collect();
    let u: Vec<f64> = description.inputs.iter().map(|input| input.nominal).collect();
    let mut errors = vec![[0.0; 6]; description.frames.len()];
    let mut transforms = vec![Pose::IDENTITY; description.frames.len() + 1];
    let magnitudes = repeatable_magnitudes(description);
    if interpreter.generalized_errors(&q, &s, &u, &mut errors).is_err()
        || interpreter.transforms(&q, &s, &mut transforms).is_err()
    {
        return;
    }
    let Ok(Some(found)) = interpreter.drawn_pose(&q, &s, &u, &magnitudes) else { return };
    let expected = real_pose(&transforms, &errors);
    let size =
        transforms.iter().flat_map(|pose| pose.0.as_flattened()).fold(1.0, |size: f64, x| size.max(x.abs()));
    for (a, b) in found.0.as_flattened().iter().zip(expected.0.as_flattened()) {
        assert!((a - b).abs() <= 1e-9 * size, "{a} {b}:\n{text}");
    }
});
