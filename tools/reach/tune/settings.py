"""The parameters that are looked for, what they follow from, and the YAML file that holds them."""

from dataclasses import dataclass, replace
from math import comb, sqrt

from .columns import Look

MOST_FEATURES = 800  # of an expert: more cost milliseconds a sample


@dataclass(frozen=True)
class Settings:
    """Shares are of ranges, so that they mean the same for every robot."""

    width: float = 1.0  # scale / range of the inputs
    doubt: float = 0.025  # sqrt(psi0) / range of the outputs
    noise: float = 0.1  # noise of the samples / sqrt(psi0)
    p0: float = 1e-3
    ridge: float = 1e-5
    degree: int = 3
    body: bool = False

    def as_body(self) -> "Settings":
        return replace(self, body=True)


def most_degree(inputs: int) -> int:
    return max(n for n in range(1, 7) if comb(inputs + n, n) <= MOST_FEATURES or n == 1)


def start_for(look: Look) -> Settings:
    """What the pages advise where nothing else is known."""
    return Settings(degree=min(4, most_degree(len(look.inputs))))


def _round(number: float) -> float:
    return float(f"{number:.3g}")


def scales(settings: Settings, look: Look) -> list[float]:
    if look.one_unit_in:
        return [_round(settings.width * look.widest)] * len(look.inputs)
    return [_round(settings.width * (column.range or 1.0)) for column in look.inputs]


def deviations(settings: Settings, look: Look) -> list[float]:
    """sqrt(psi0) of each output."""
    ranges = [column.range or 1.0 for column in look.outputs]
    if look.one_unit_out:
        ranges = [max(ranges)] * len(ranges)
    return [_round(settings.doubt * r) for r in ranges]


def yaml_of(settings: Settings, look: Look, origin: str) -> str:
    """A file for reach-eval and reach-learner, every line with its reason."""
    scale, deviation = scales(settings, look), deviations(settings, look)
    d = len(look.inputs)
    features = comb(d + settings.degree, settings.degree)
    noise_share = _round(settings.noise**2)
    noise = [_round(v * sqrt(noise_share)) for v in deviation]
    sigma0 = [_round(6.0 * s * s) for s in scale]
    experts = "body" if settings.body else "polynomial"
    why = ("polynomial until a body is found, then a tip on it for each branch" if settings.body
           else "one expert for each branch, such as a tool")  # fmt: skip
    lines = [
        f"# {origin}",
        "# Variances are variances, in the squared units of the columns.",
        f"experts: {experts}  # {why}",
        f"degree: {settings.degree}  # of the polynomial: {features} features",
        f"capacity: {16 if features > 100 else 64}  # most experts",
        f"reference: {_list(_round(c.middle) for c in look.inputs)}  # middle of each range",
        f"scale: {_list(scale)}  # width of the kernel, in the inputs' units",
        f"psi0: {_list(_round(v * v) for v in deviation)}"
        f"  # deviation {_words(deviation)}: what the model may not know yet",
        f"noise_share: {noise_share}  # noise of the samples {_words(noise)}: its variance / psi0",
        f"p0: {_round(settings.p0)}  # smaller: a sample must be further off to make a new expert",
        f"ridge: {_round(settings.ridge)}  # smaller: an expert bends more freely",
        f"sigma0: {_list(sigma0)}  # variance of the inputs that a new expert covers: all",
        "alpha: 0.999  # forgetting; 1: nothing is forgotten",
        f"hyper_sigma: {2**d}",
        f"prior_sigma: {2**d}",
        "prior_nu: 0",
        "hyper_psi: .inf  # psi0 stays as it is given",
        "prior_psi: .inf",
        "n_outliers: 1  # single wrong samples leave no trace",
        "inherit: true  # a new branch begins as the nearest one, shifted",
        "clustering: leader",
        "leader_level: 0.9999",
        "kappa: 0.5",
        "gamma_floor: 0.05",
    ]
    return "\n".join(lines) + "\n"


def _list(numbers) -> str:
    return "[" + ", ".join(f"{number:g}" for number in numbers) + "]"


def _words(numbers) -> str:
    return ", ".join(f"{number:g}" for number in dict.fromkeys(numbers))
