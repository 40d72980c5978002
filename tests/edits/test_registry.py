"""The registry reads signatures, fills in, checks and scales parameters, and says what would fit."""

from collections.abc import Iterator
from typing import Annotated, Any, Literal

import numpy as np
import pytest

from mien.edits.registry import EDITS, Edit, Param, edit
from mien.errors import RecipeError
from mien.motion import Motion, Skeleton
from mien.recipe import Step


@pytest.fixture(autouse=True)
def registry() -> Iterator[None]:
    """Edits made here are gone afterwards."""
    before = dict(EDITS)
    yield
    EDITS.clear()
    EDITS.update(before)


@pytest.fixture
def still() -> Motion:
    one = np.array([[[0, 0, 0, 1.0]]] * 3)
    return Motion(Skeleton(("hips",), [-1], [[0, 0, 0]]), one, np.zeros((3, 1, 3)), 0.1)


@pytest.fixture
def wobble() -> Any:
    @edit(paper="Somebody 1999", equation="x' = a x", deviations="none")
    def wobble(
        motion: Motion,
        *,
        amount: Annotated[float, Param("How much", low=0, high=3, unit="times", neutral=1)] = 1.0,
        angle: Annotated[float, Param("Turn", low=-90, high=90, unit="degrees", neutral=0)] = 0.0,
        least: Annotated[float, Param("At least", low=0.5)] = 1.0,
        most: Annotated[float, Param("At most", high=2)] = 1.0,
        count: Annotated[int, Param("How many", low=1, high=9)] = 3,
        mode: Annotated[Literal["soft", "hard"], Param("Which way")] = "soft",
        limbs: Annotated[tuple[Literal["arm", "leg"], ...], Param("Which limbs")] = ("arm",),
        loop: Annotated[bool, Param("A loop")] = False,
        file: Annotated[str | None, Param("A file")] = None,
    ) -> Motion:
        """Wobble the motion.

        More about it.
        """
        return motion.with_(translations=motion.translations + amount)

    return wobble


@pytest.fixture
def found(wobble: Any) -> Edit:
    return EDITS["wobble"]


def test_what_the_decorator_records(found: Edit) -> None:
    assert (found.name, found.kind, found.summary) == ("wobble", "pose", "Wobble the motion.")
    assert (found.paper, found.equation, found.deviations) == ("Somebody 1999", "x' = a x", "none")
    kinds = {name: p.kind for name, p in found.parameters.items()}
    assert kinds == {
        "amount": float,
        "angle": float,
        "least": float,
        "most": float,
        "count": int,
        "mode": str,
        "limbs": tuple,
        "loop": bool,
        "file": str,
    }
    assert found.parameters["mode"].choices == ("soft", "hard")
    assert found.parameters["limbs"].choices == ("arm", "leg")
    assert [n for n, p in found.parameters.items() if p.optional] == ["file"]
    assert found.parameters["amount"].doc == "How much"


def test_missing_parameters_take_their_defaults(found: Edit) -> None:
    assert found.complete({"amount": 2}) == {
        "amount": 2.0,
        "angle": 0.0,
        "least": 1.0,
        "most": 1.0,
        "count": 3,
        "mode": "soft",
        "limbs": ("arm",),
        "loop": False,
        "file": None,
    }


@pytest.mark.parametrize(
    ("given", "kept"),
    [
        ({"amount": 2}, 2.0),
        ({"amount": np.float32(0.5)}, 0.5),
        ({"amount": np.int64(2)}, 2.0),
        ({"count": 4.0}, 4),
        ({"limbs": "leg"}, ("leg",)),
        ({"limbs": ["leg", "arm"]}, ("leg", "arm")),
        ({"limbs": []}, ()),
        ({"file": None}, None),
        ({"file": "pose.bvh"}, "pose.bvh"),
        ({"loop": True}, True),
    ],
)
def test_values_that_fit_become_plain_data(found: Edit, given: dict[str, Any], kept: Any) -> None:
    value = found.complete(given)[next(iter(given))]
    assert value == kept
    assert type(value) is type(kept)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"amount": 3.5}, "wobble: amount must be from 0 to 3 times, got 3.5"),
        ({"amount": -0.1}, "wobble: amount must be from 0 to 3 times, got -0.1"),
        ({"amount": float("nan")}, "wobble: amount must be a number, got nan"),
        ({"least": float("inf")}, "wobble: least must be a number, got inf"),
        ({"count": float("inf")}, "wobble: count must be a number, got inf"),
        ({"least": 0.1}, "wobble: least must be at least 0.5, got 0.1"),
        ({"most": 2.5}, "wobble: most must be at most 2, got 2.5"),
        ({"amount": "2"}, "wobble: amount must be a number, got '2'"),
        ({"amount": True}, "wobble: amount must be a number, got True"),
        ({"amount": None}, "wobble: amount must be a number, got None"),
        ({"count": 2.5}, "wobble: count must be a whole number, got 2.5"),
        ({"count": 10}, "wobble: count must be from 1 to 9, got 10"),
        ({"mode": "hart"}, "wobble: mode: there is no choice 'hart'; did you mean 'hard'?"),
        ({"mode": 1}, "wobble: mode must be text, got 1"),
        ({"limbs": ["arm", "log"]}, "there is no choice 'log'; did you mean 'leg'?"),
        ({"limbs": 4}, "wobble: limbs must be a list, got 4"),
        ({"loop": 1}, "wobble: loop must be true or false, got 1"),
        ({"amonut": 1}, "there is no parameter 'amonut'; did you mean 'amount'?"),
        ({"zzz": 1}, "known: amount, angle, count"),
    ],
)
def test_what_does_not_fit_is_named_with_what_would(
    found: Edit, wobble: Any, still: Motion, given: dict[str, Any], message: str
) -> None:
    for refuse in (lambda: found.complete(given), lambda: wobble(still, **given)):
        with pytest.raises(RecipeError) as caught:
            refuse()
        assert message in str(caught.value)


@pytest.mark.parametrize(
    ("strength", "amount", "angle"),
    [(0.0, 1.0, 0.0), (0.5, 1.25, 20.0), (1.0, 1.5, 40.0), (2.0, 2.0, 80.0)],
)
def test_strength_moves_a_parameter_from_neutral(
    found: Edit, strength: float, amount: float, angle: float
) -> None:
    values = found.complete({"amount": 1.5, "angle": 40, "count": 5, "most": 0.1})
    scaled = found.scaled(values, strength)
    assert (scaled["amount"], scaled["angle"]) == pytest.approx((amount, angle))
    same = {k: v for k, v in scaled.items() if k not in ("amount", "angle")}
    assert same == {k: values[k] for k in same}, "parameters without a neutral value do not follow strength"


def test_strength_stays_within_the_range(found: Edit) -> None:
    scaled = found.scaled(found.complete({"amount": 2.5, "angle": -60}), 2.0)
    assert (scaled["amount"], scaled["angle"]) == (3.0, -90.0)


def test_a_call_appends_its_step_with_every_parameter(wobble: Any, still: Motion) -> None:
    before = still.with_(history=(Step("earlier"),))
    after = wobble(before, amount=2)
    assert [s.edit for s in after.history] == ["earlier", "wobble"]
    assert after.history[-1].parameters == EDITS["wobble"].complete({"amount": 2})
    assert after.translations.max() == 2.0
    assert before.history == (Step("earlier"),)


def test_a_repair_also_takes_the_original(still: Motion) -> None:
    @edit(kind="repair", paper="none")
    def mend(motion: Motion, *, original: Motion | None = None) -> Motion:
        """Take the original's place."""
        return motion if original is None else original

    other = still.with_(name="other")
    assert mend(still, original=other).name == "other"
    assert mend(still).history == (Step("mend", {}),)
    assert EDITS["mend"].parameters == {}


def test_only_a_repair_takes_the_original(wobble: Any, still: Motion) -> None:
    with pytest.raises(RecipeError, match="there is no parameter 'original'"):
        wobble(still, original=still)


def test_a_signature_that_cannot_be_wired_is_refused_at_import() -> None:
    amount = Annotated[float, Param("How much")]

    def positional(motion: Motion, amount: amount = 1.0) -> Motion:  # type: ignore[valid-type]
        return motion

    def required(motion: Motion, *, amount: amount) -> Motion:  # type: ignore[valid-type]
        return motion

    def bare(motion: Motion, *, amount: float = 1.0) -> Motion:
        return motion

    for function in (positional, required, bare):
        function.__annotations__["amount"] = float if function is bare else amount
        with pytest.raises(TypeError, match="keyword-only, with a default and a Param"):
            edit(paper="none")(function)
        assert function.__name__ not in EDITS
