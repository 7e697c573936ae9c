//! The instruction sets that a kernel is compiled for, and the choice among them.

use core::fmt;

use pulp::NullaryFnOnce;
#[cfg(target_arch = "x86_64")]
use pulp::x86::{V3, V4};

use super::Register;

/// The register with two lanes that every machine has.
#[cfg(target_arch = "x86_64")]
type Two = crate::x86::Sse2;
#[cfg(not(target_arch = "x86_64"))]
type Two = [f64; 2];

/// Work on lanes, to be compiled for every instruction set.
///
/// Everything that it calls must be `#[inline(always)]`: what is not stays compiled for the oldest machine.
pub trait Kernel {
    /// What it returns.
    type Output;
    /// Does the work with lanes of this register.
    fn run<R: Register>(self) -> Self::Output;
}

/// An instruction set that this machine has.
#[derive(Clone, Copy)]
pub struct InstructionSet(Level);

#[derive(Clone, Copy)]
enum Level {
    Baseline,
    #[cfg(target_arch = "x86_64")]
    Avx2(V3),
    #[cfg(target_arch = "x86_64")]
    Avx512(V4),
}

impl InstructionSet {
    /// What every machine has.
    pub const BASELINE: Self = Self(Level::Baseline);

    /// The widest that this machine has. Found out once, then remembered.
    pub fn best() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            if let Some(v4) = V4::try_new() {
                return Self(Level::Avx512(v4));
            }
            if let Some(v3) = V3::try_new() {
                return Self(Level::Avx2(v3));
            }
        }
        Self::BASELINE
    }

    /// All that this machine has, the narrowest first.
    pub fn all() -> impl Iterator<Item = Self> {
        #[cfg(target_arch = "x86_64")]
        let more = [V3::try_new().map(Level::Avx2), V4::try_new().map(Level::Avx512)];
        #[cfg(not(target_arch = "x86_64"))]
        let more: [Option<Level>; 0] = [];
        [Some(Level::Baseline)].into_iter().chain(more).flatten().map(Self)
    }

    /// How many lanes it has.
    pub fn width(self) -> usize {
        match self.0 {
            Level::Baseline => 2,
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(_) => 4,
            #[cfg(target_arch = "x86_64")]
            Level::Avx512(_) => 8,
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self.0 {
            Level::Baseline => "baseline",
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(_) => "AVX2 + FMA",
            #[cfg(target_arch = "x86_64")]
            Level::Avx512(_) => "AVX-512",
        }
    }

    /// Runs a kernel, compiled for this instruction set.
    #[inline]
    pub fn run<K: Kernel>(self, kernel: K) -> K::Output {
        match self.0 {
            Level::Baseline => kernel.run::<Two>(),
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(v3) => v3.vectorize(With::<K, crate::x86::Avx2>::new(kernel)),
            #[cfg(target_arch = "x86_64")]
            Level::Avx512(v4) => v4.vectorize(With::<K, crate::x86::Avx512>::new(kernel)),
        }
    }
}

/// A kernel with its register.
struct With<K, R>(K, core::marker::PhantomData<R>);

impl<K, R> With<K, R> {
    #[inline(always)]
    fn new(kernel: K) -> Self {
        Self(kernel, core::marker::PhantomData)
    }
}

impl<K: Kernel, R: Register> NullaryFnOnce for With<K, R> {
    type Output = K::Output;

    #[inline(always)]
    fn call(self) -> K::Output {
        self.0.run::<R>()
    }
}

impl fmt::Debug for InstructionSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl PartialEq for InstructionSet {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}

impl Eq for InstructionSet {}
