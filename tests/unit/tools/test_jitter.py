"""Reading cyclictest's histogram, and the table of ./run jitter."""

import unittest

from reach import jitter

HISTOGRAM = """# /dev/cpu_dma_latency set to 0us
# Histogram
000000 000000
000007 000003
000120 000001
# Total: 000000004
"""


class Jitter(unittest.TestCase):
    def test_cyclictest_latencies(self):
        self.assertEqual(jitter.cyclictest_latencies(HISTOGRAM).tolist(), [7, 7, 7, 120])

    def test_table_and_picture(self):
        times = {f"{key}_us": [1.0] * 999 + [2500.0] for key in
                 ("wakeup", "cyclictest", "compute", "age")}  # fmt: skip
        run = {"load": "quiet", "ticks": 1000, "experts": 1000, "overruns": 2, "slips": 1,
               "page_faults": 0, **times}  # fmt: skip
        line = jitter.table([run]).splitlines()[2]
        self.assertIn("quiet, 1000 experts | 1000 |", line)
        self.assertRegex(line, r"1 / [\d,]+ / 2,500")
        self.assertTrue(line.endswith("| 2 | 1 | 0 |"))
        self.assertEqual(len(jitter.picture([run]).axes), 2)


if __name__ == "__main__":
    unittest.main()
