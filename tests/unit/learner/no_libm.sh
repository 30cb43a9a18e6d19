#!/usr/bin/env bash
# no_libm.sh NM LIBRARY: fails when the learner calls a function whose last bits a C library
# chooses by the processor.
set -euo pipefail
undefined=$("$1" -u "$2" | awk '$1 == "U" {print $2}' | sort -u)
grep -qx memcpy <<<"$undefined" || {
    echo "no undefined symbols in $2: is it the learner's library?"
    exit 1
}
if grep -xE '(exp|expm1|exp2|log|log1p|log2|log10|pow|cbrt|hypot|lgamma|lgamma_r|tgamma|sin|cos|sincos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|erf|erfc|fma)f?' \
    <<<"$undefined"; then
    echo "the learner must use common/base/elementary.h instead"
    exit 1
fi
