"""What small functions of questions/diagnosis return."""

from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.questions.diagnosis.fault_answer import fault_words
from cardan.questions.diagnosis.figures.orders import order_text, quantity_word, trusted, unit_of
from cardan.questions.diagnosis.figures.signals import verdict
from cardan.questions.diagnosis.findings import Finding
from cardan.questions.diagnosis.signals.signal import Watch


def test_fault_words():
    assert (fault_words("unbalance"), fault_words("healthy")) == ("unbalance of a shaft", "nothing wrong")


def test_order_text():
    assert (order_text(2.004), order_text(0.47)) == ("2", "0.47")


def test_trusted():
    assert (
        told(trusted("Order 2 is the highest.", 0.9), USUAL),
        told(trusted("Order 2 is the highest.", 0.25), USUAL),
    ) == ("Order 2 is the highest.", "Order 2 is the highest. The confidence is only 25 %.")


def test_quantity_word():
    assert quantity_word("angular_speed") == "speed"


def test_unit_of():
    assert (unit_of("velocity"), unit_of("pulses")) == (("speed", "mm_s", 0.001), ("", "", 1.0))


def test_verdict():
    one = Finding(cause="F01", fault="unbalance", score=0.81, confidence=0.9)
    other = Finding(cause="F02", fault="tube bent", score=0.1, confidence=0.9)
    assert told(verdict([one, other]), USUAL) == "Likely: unbalance (81 %)."


def test_watch():
    told = []
    watch = Watch(told.append, 4)
    assert (watch(0.5), watch.next(), watch(0.5), told) == (None, None, None, [0.125, 0.25, 0.375])
