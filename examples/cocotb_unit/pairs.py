"""Random rays and boxes for a unit: what its ports get, and what its results must be. No simulator is needed."""
import hitpipe
import numpy


class Pairs:
    """Tests of a unit, each with the words of its ports by name."""

    def __init__(self, design, bits="", count=1000, seed=1):
        self.unit = hitpipe.Unit(design, bits)
        rays, boxes = random_pairs(count, self.unit.boxes_per_test, seed)
        self.answers = self.unit.test_pairs(rays, boxes)
        self.operands = words(self.unit.ports, self.answers.operands)
        self.results = words(self.unit.results, self.answers.results)

    def __len__(self):
        return len(self.operands)


def random_pairs(count, boxes_per_test, seed):
    """Rays that aim near their first box; every fourth ray has an end."""
    random = numpy.random.default_rng(seed)
    half = random.uniform(0.01, 0.3, (count, boxes_per_test, 3))
    middle = random.uniform(-0.7, 0.7, (count, boxes_per_test, 3))
    boxes = numpy.stack([middle - half, middle + half], axis=2).astype(numpy.float32)
    rays = numpy.empty((count, 7), numpy.float32)
    rays[:, 0:3] = random.uniform(-1, 1, (count, 3))
    rays[:, 3:6] = middle[:, 0] + 2 * half[:, 0] * random.uniform(-1, 1, (count, 3)) - rays[:, 0:3]
    rays[:, 6] = numpy.where(random.random(count) < 0.25, random.uniform(0, 2, count), numpy.inf)
    return rays, boxes if boxes_per_test > 1 else boxes[:, 0]


def words(ports, numbers):
    """For each test, by the names of the ports, the numbers as the ports have them: cut to their widths, unsigned."""
    return [{port.name: int(number) & ((1 << port.width) - 1) for port, number in zip(ports, row)} for row in numbers.tolist()]


class Judge:
    """Takes results in the order of the tests and counts what is wrong."""

    def __init__(self, pairs):
        self.pairs = pairs
        self.came = self.hits = self.mismatches = self.false_misses = 0

    def take(self, results):
        """`results` by the names of the ports."""
        place = self.came
        self.came += 1
        if place >= len(self.pairs):
            self.mismatches += 1
            return
        self.mismatches += results != self.pairs.results[place]
        exact = numpy.atleast_1d(self.pairs.answers.exact[place])
        for port in self.pairs.unit.results:
            if port.meaning == "hit":
                self.hits += results[port.name]
                self.false_misses += bool(exact[port.box] and not results[port.name])

    def passed(self):
        wrong = self.mismatches or (self.pairs.unit.conservative and self.false_misses)
        return self.came == len(self.pairs) and not wrong

    def __str__(self):
        return (f"{self.came} of {len(self.pairs)} tests: {self.hits} hits, {self.mismatches} mismatches, "
                f"{self.false_misses} false misses")
