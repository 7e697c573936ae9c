//! Instruction sets that kernels are compiled for, and the selection at run time.

use core::fmt;
#[cfg(target_arch = "x86_64")]
use core::marker::PhantomData;

#[cfg(target_arch = "x86_64")]
use pulp::{
    NullaryFnOnce,
    x86::{V3, V4},
};

use super::Register;
use crate::floats::Two;

/// Computation on lanes, compiled for every instruction set.
///
/// Everything it calls must be `#[inline(always)]`: other functions are compiled for the baseline
/// instruction set.
pub trait Kernel {
    /// Result of the computation.
    type Output;
    /// Runs the computation with lanes of this register.
    fn run<R: Register>(self) -> Self::Output;
}

/// Instruction set that this machine has.
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
    /// Instruction set that every machine of this architecture has.
    pub const BASELINE: Self = Self(Level::Baseline);

    /// Returns the widest instruction set of this machine. The detection is cached.
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

    /// Iterates over the instruction sets of this machine, the narrowest first.
    pub fn all() -> impl Iterator<Item = Self> {
        #[cfg(target_arch = "x86_64")]
        let more = [V3::try_new().map(Level::Avx2), V4::try_new().map(Level::Avx512)];
        #[cfg(not(target_arch = "x86_64"))]
        let more: [Option<Level>; 0] = [];
        [Some(Level::Baseline)].into_iter().chain(more).flatten().map(Self)
    }

    /// Returns the number of lanes.
    pub fn width(self) -> usize {
        match self.0 {
            Level::Baseline => 2,
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(_) => 4,
            #[cfg(target_arch = "x86_64")]
            Level::Avx512(_) => 8,
        }
    }

    /// Returns the name.
    pub fn name(self) -> &'static str {
        match self.0 {
            Level::Baseline => "baseline",
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(_) => "AVX2 + FMA",
            #[cfg(target_arch = "x86_64")]
            Level::Avx512(_) => "AVX-512",
        }
    }

    /// Runs a kernel compiled for this instruction set.
    #[inline]
    pub fn run<K: Kernel>(self, kernel: K) -> K::Output {
        match self.0 {
            Level::Baseline => kernel.run::<Two>(),
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(v3) => v3.vectorize(With(kernel, PhantomData::<crate::x86::Avx2>)),
            #[cfg(target_arch = "x86_64")]
            Level::Avx512(v4) => v4.vectorize(With(kernel, PhantomData::<crate::x86::Avx512>)),
        }
    }
}

/// Kernel with its register type.
#[cfg(target_arch = "x86_64")]
struct With<K, R>(K, PhantomData<R>);

#[cfg(target_arch = "x86_64")]
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
