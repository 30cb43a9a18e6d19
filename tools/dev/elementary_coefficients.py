"""The polynomials of common/base/elementary.h: Chebyshev interpolation with 80 digits.

Prints, for each function, the coefficients (lowest power first) as hexadecimal doubles and the
largest relative error of the polynomial before rounding.
    exp:  P(r) = (e^r - 1 - r) / r^2          for |r| <= log(2)/2
    log:  Q(w) = (2 atanh(s)/s - 2) / w, w = s^2,  for s = (m-1)/(m+1), m from 1/sqrt(2) to sqrt(2)
"""

from decimal import Decimal, getcontext

getcontext().prec = 80
PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494459230781640628620899")
LN2 = Decimal(2).ln()
TERMS = 120


def cosine(x):
    """cos(x) by its power series."""
    total, term = Decimal(0), Decimal(1)
    for n in range(1, TERMS):
        total += term
        term *= -x * x / ((2 * n - 1) * (2 * n))
    return total


def exp_part(r):
    """(e^r - 1 - r) / r^2."""
    total, term = Decimal(0), Decimal(1) / 2
    for n in range(3, TERMS):
        total += term
        term *= r / n
    return total


def log_part(w):
    """(2 atanh(s)/s - 2) / s^2 at w = s^2."""
    return sum(Decimal(2) / (2 * n + 3) * w**n for n in range(TERMS))


def interpolate(f, low, high, degree):
    """Monomial coefficients of the interpolant at the Chebyshev nodes (Newton's form, expanded)."""
    n = degree + 1
    nodes = [
        (low + high) / 2 + (high - low) / 2 * cosine(PI * (2 * i + 1) / (2 * n)) for i in range(n)
    ]
    divided = [f(x) for x in nodes]
    for order in range(1, n):
        for i in range(n - 1, order - 1, -1):
            divided[i] = (divided[i] - divided[i - 1]) / (nodes[i] - nodes[i - order])
    coefficients = [divided[-1]]
    for i in range(n - 2, -1, -1):
        coefficients = [Decimal(0), *coefficients]
        for k in range(len(coefficients) - 1):
            coefficients[k] -= nodes[i] * coefficients[k + 1]
        coefficients[0] += divided[i]
    return coefficients


def worst(f, coefficients, low, high):
    """Largest relative error on a fine grid."""
    errors = []
    for i in range(401):
        x = low + (high - low) * i / 400
        value = sum(c * x**k for k, c in enumerate(coefficients))
        errors.append(abs(value / f(x) - 1))
    return max(errors)


def show(name, f, low, high, degree):
    """One polynomial."""
    coefficients = interpolate(f, low, high, degree)
    print(f"{name}: relative error {worst(f, coefficients, low, high):.1e}")
    for c in coefficients:
        print(f"    {float(c).hex()}")


def main():
    """Everything that elementary.h holds."""
    high = int(LN2 * 2**42) / Decimal(2**42)
    print(f"log 2 = {float(high).hex()} + {float(LN2 - high).hex()}")
    show("exp", exp_part, -LN2 / 2, LN2 / 2, 10)
    root = Decimal(2).sqrt()
    largest = ((root - 1) / (root + 1)) ** 2
    show("log", log_part, Decimal("1e-30"), largest, 7)


if __name__ == "__main__":
    main()
