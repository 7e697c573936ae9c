//! Operators, numbers and names of Structured Text.

use std::borrow::Cow;

use abbe_core::Function as Routine;
use abbe_spec::{Function, Lookup, Spec};

use super::Support;
use crate::print::expression::Called;
use crate::print::{Binding, Expression, Identifiers, Syntax, arithmetic, distinct};
use crate::procedure::{Precision, compensated};
use crate::program::{Action, Routines};

/// The syntax of Structured Text for a file.
pub(super) struct StructuredText {
    /// Prefix of the names of the file.
    pub(super) prefix: String,
    /// Functions of the lookup tables.
    pub(super) tables: Vec<String>,
    /// Names that the blocks use, separated by spaces.
    reserved: String,
}

/// Maximum length of a name, with a reserve for suffixes that make it unique.
const LONGEST: usize = 55;

/// Keywords, standard functions and function blocks of the three editions of IEC 61131-3, of
/// CODESYS and of TwinCAT, and operators of the instruction list, which CODESYS and TwinCAT
/// reserve as well.
pub(super) const WORDS: &str = "ABS ABSTRACT ACOS ACTION ADD ADD_DT_TIME ADD_TIME ADD_TOD_TIME ADR AND ANDN AND_THEN ANY ANY_BIT ANY_DATE ANY_INT ANY_NUM ANY_REAL \
     ARRAY ASIN AT ATAN ATAN2 BCD_TO_INT BIT BITADR BOOL BY BYTE CAL CALC CALCN CASE CATCH CD CEIL CHAR CLASS CLK CONCAT CONFIGURATION \
     CONSTANT CONTINUE COS CTD CTU CTUD CU DATE DATE_AND_TIME DELETE DINT DIV DO DT DWORD ELSE ELSIF EN END_ACTION \
     END_CASE END_CLASS END_CONFIGURATION END_FOR END_FUNCTION END_FUNCTION_BLOCK END_IF END_INTERFACE END_METHOD END_NAMESPACE \
     END_PROGRAM END_PROPERTY END_REPEAT END_RESOURCE END_STEP END_STRUCT END_TRANSITION END_TYPE END_UNION END_VAR END_WHILE ENO EQ \
     EXIT EXP EXPT EXTENDS FALSE FINAL FINALLY FIND FLOOR FOR FROM FUNCTION FUNCTIONBLOCK FUNCTION_BLOCK F_EDGE F_TRIG GE GET GOTO \
     GT IF IMPLEMENTS IN INDEXOF INI INITIAL_STEP INSERT INT INTERFACE INTERNAL JMP JMPC JMPCN LD LDATE LDN LDT LE LEFT LEN \
     LIMIT LINT LN LOG LOWER_BOUND LREAL LT LTIME LTOD LWORD MAX METHOD MID MIN MOD MOVE MUL MUX NAMESPACE NE NON_RETAIN NOP \
     NOT NULL OF ON OR ORN OR_ELSE OVERLAP OVERRIDE PARAMS PERSISTENT POINTER PRIVATE PROGRAM PROPERTY PROTECTED PT PUBLIC \
     PV QD QU R R1 READ_ONLY READ_WRITE REAL REF REFERENCE REF_TO REPEAT REPLACE RESOURCE RET RETAIN RETC RETCN RETURN RIGHT ROL \
     ROR RS RTC R_EDGE R_TRIG S SEL SEMA SET SHL SHR SIN SINT SIZEOF SQRT SR ST STEP STN STRING STRING_BYTE STRUCT \
     SUB SUPER TAN TASK THEN THIS TIME TIME_OF_DAY TO TOD TOF TON TP TRANSITION TRUE TRUNC TRY TYPE UDINT UINT ULINT UNION UNTIL UPPER_BOUND \
     USING USINT VAR VAR_ACCESS VAR_CONFIG VAR_EXTERNAL VAR_GLOBAL VAR_INPUT VAR_INST VAR_IN_OUT VAR_OUTPUT VAR_STAT VAR_TEMP WCHAR \
     WHILE WITH WORD WSTRING XOR XORN XWORD";

/// Variables of the blocks beside the arrays of the functions.
const OWN: &str = "fault i inputs k lower_ranges margin parameters status total upper_ranges";

impl StructuredText {
    pub(super) fn new(spec: &Spec, routines: &Routines) -> Self {
        let prefix = spelled(&spec.name);
        let mut tables: Vec<String> = Vec::new();
        for table in &spec.tables {
            let name = format!("{prefix}_table_{}", spelled(&table.name));
            let is_taken = |name: &str| tables.iter().any(|other| other.eq_ignore_ascii_case(name));
            tables.push(distinct(name, SUFFIX, is_taken));
        }
        let procedures = compensated(spec, Precision::Double);
        let mut reserved = format!("{WORDS} {OWN} {}", tables.join(" "));
        let called =
            routines.list.iter().map(|routine| routine.name).chain(procedures.iter().map(|one| one.name));
        let called = called.chain(Routine::ALL.map(Routine::name));
        reserved.extend(called.map(|name| format!(" {prefix}_{name} {}", instance(name))));
        reserved.extend(Support::names().map(|name| format!(" {prefix}_{name}")));
        reserved.extend(routines.tables.iter().map(|table| format!(" {0}_0 {0}_1", table.name)));
        let of_sums = |name| format!(" {name}_CONSTANTS {name}_ENTRIES {name}_TERMS {name}_FACTORS");
        reserved.extend(routines.sums.iter().map(|sums| of_sums(&sums.name)));
        // Types of arrays have names such as `arm_array_6`.
        let types = ["array", "counts"].map(|kind| format!("{prefix}_{kind}_").to_lowercase());
        let own = spec.variables.iter().chain(&spec.passive).map(|one| &one.name);
        let own = own.chain(spec.parameters.iter().map(|one| &one.name));
        let own = own.chain(spec.inputs.iter().map(|one| &one.name));
        let is_type = |name: &&String| types.iter().any(|kind| name.to_lowercase().starts_with(kind));
        reserved.extend(own.filter(is_type).map(|name| format!(" {name}")));
        Self { prefix, tables, reserved }
    }

    /// Returns the call of a function of the file, which has an argument for faults if it is
    /// guarded.
    fn own(&self, support: Support, operands: &[Expression]) -> Expression {
        let mut operands = operands.to_vec();
        operands.extend(support.is_guarded().then(|| Expression::name("fault".to_owned())));
        Expression::call(&format!("{}_{}", self.prefix, support.name()), &operands)
    }
}

impl Syntax for StructuredText {
    fn reserved(&self) -> Cow<'static, str> {
        Cow::Owned(self.reserved.clone())
    }

    /// Names that differ in case only are the same; two adjacent underscores, and one at the end,
    /// are not allowed.
    fn identifiers(&self) -> Identifiers {
        Identifiers { spelled, key: str::to_ascii_lowercase, suffix: SUFFIX }
    }

    /// Typed numbers are double in every dialect. Negative ones get parentheses as operands.
    fn number(&self, value: f64) -> Expression {
        Expression::new(number(value), if value.is_sign_negative() { Binding::Choice } else { Binding::Atom })
    }

    fn action(&self, action: Action, operands: &[Expression]) -> Expression {
        if let Some(support) = Support::for_action(action) {
            return self.own(support, operands);
        }
        let call = |name: &str| Expression::call(name, operands);
        if let Action::Neg(_) = action {
            // `-` binds less than `*` in some dialects.
            return Expression::new(format!("-{}", operands[0].at_least(Binding::Atom)), Binding::Choice);
        }
        arithmetic(action, operands).unwrap_or_else(|called| match called {
            Called::Least => call("MIN"),
            Called::Greatest => call("MAX"),
            Called::Function(Function::Abs) => call("ABS"),
            Called::Function(Function::Atan) => call("ATAN"),
            Called::Lookup(Lookup { table, order }) => {
                let (name, x) = (&self.tables[usize::from(table)], &operands[0].text);
                Expression::new(format!("{name}({order}, {x}, fault)"), Binding::Atom)
            }
            // All others are functions of the file.
            Called::Power | Called::Atan2 | Called::Function(_) => call("TAN"),
        })
    }
}

/// End of a name that makes it distinct.
const SUFFIX: &str = "_2";

/// Returns the name of the instance of a routine's block.
pub(super) fn instance(routine: &str) -> String {
    format!("run_{routine}")
}

/// Converts a name of a spec to an identifier: no underscore at an end or beside another one, and
/// nothing that begins like the end of a statement.
pub(super) fn spelled(name: &str) -> String {
    let parts: Vec<&str> = name.split('_').filter(|part| !part.is_empty()).collect();
    let joined = parts.join("_");
    let is_end = parts.first().is_some_and(|first| first.eq_ignore_ascii_case("end"));
    let is_plain = joined.starts_with(|first: char| first.is_ascii_alphabetic()) && !is_end;
    let begun = if is_plain { "" } else { "x" };
    let name = format!("{begun}{joined}");
    name[..name.len().min(LONGEST)].trim_end_matches('_').to_owned()
}

/// Returns the shortest typed literal that represents the number exactly.
pub(super) fn number(value: f64) -> String {
    let sign = if value.is_sign_negative() { "-" } else { "" };
    format!("{sign}LREAL#{}", initial(value.abs()))
}

/// Largest number, which stands for infinity: some compilers read each as a REAL before they take
/// it for an LREAL.
const INFINITE: f64 = 1e37;

/// Returns the shortest literal of an initial value, with a point and a capital exponent.
pub(super) fn initial(value: f64) -> String {
    let text = format!("{:?}", value.clamp(-INFINITE, INFINITE));
    match text.split_once('e') {
        None => text,
        Some((mantissa, exponent)) if mantissa.contains('.') => format!("{mantissa}E{exponent}"),
        Some((mantissa, exponent)) => format!("{mantissa}.0E{exponent}"),
    }
}
