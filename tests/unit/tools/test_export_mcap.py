"""The MCAP files of reach-export, read by the libraries of others."""

import json
import unittest
import warnings

import numpy as np
import synthetic
from export_bed import JOINTS, Exported, filled, joint_state, state, status, stereo
from mcap.reader import NonSeekingReader, make_reader
from mcap_protobuf.decoder import DecoderFactory
from reach import read_log
from reach.messages import CHANNELS, bot_core, described
from reach.messages import reach as types


class Mcap(Exported):
    def mcap(self, *words) -> list[tuple]:
        """Schema, channel, message and decoded message of each, in the order of the file."""
        path = self.folder / "run.mcap"
        self.said = self.export("--mcap", path, *words)
        with path.open("rb") as file, warnings.catch_warnings():
            warnings.simplefilter("error")
            found = list(NonSeekingReader(file, validate_crcs=True,
                                          decoder_factories=[DecoderFactory()])
                         .iter_decoded_messages(log_time_order=False))  # fmt: skip
            file.seek(0)
            reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
            ordered = list(reader.iter_decoded_messages())
            statistics = reader.get_summary().statistics
        self.assertEqual(statistics.message_count, len(found))
        counts = statistics.channel_message_counts
        for number in counts:
            self.assertEqual(sum(c.id == number for _, c, _, _ in found), counts[number])
        key = lambda entry: (entry[2].log_time, entry[1].topic, entry[2].sequence)  # noqa: E731
        self.assertEqual(sorted(map(key, ordered)), sorted(map(key, found)))
        times = [message.log_time for _, _, message, _ in ordered]
        self.assertEqual(times, sorted(times))
        return found

    def test_a_whole_run_is_the_same_in_every_field(self):
        synthetic.make(self.folder)
        record = read_log(self.log)
        seen = dict.fromkeys(CHANNELS, 0)
        for schema, channel, message, decoded in self.mcap():
            row = record[channel.topic[1:]][seen[channel.topic[1:]]]
            seen[channel.topic[1:]] += 1
            self.assertEqual(schema.name, f"reach.{CHANNELS[channel.topic[1:]]}")
            self.assertEqual((message.publish_time, message.sequence),
                             (row["utime"] * 1000, row["seq"]))  # fmt: skip
            if seen[channel.topic[1:]] % 10 == 0:
                self.compare(described(CHANNELS[channel.topic[1:]]), row, decoded)
        self.assertEqual(seen, {channel: len(record[channel]) for channel in CHANNELS})

    def compare(self, about, row, decoded) -> None:
        for entry in about.fields:
            found = getattr(decoded, entry.plain_name)
            used = [
                size if count is None else row[count]
                for size, count in zip(entry.dimensions, about.counts(entry), strict=True)
            ]
            wanted = row[entry.plain_name]
            if len(used) == 2:
                found = [list(line.column) for line in found]
            wanted = wanted[tuple(slice(n) for n in used)] if used else wanted
            np.testing.assert_array_equal(np.array(found).reshape(used), wanted, entry.name)

    def test_it_is_in_the_order_of_the_log(self):
        self.write(
            [
                ("ROBOT_STATE", 5_000_000, state(1, utime=9)),
                ("REACH_STATUS", 4_000_000, status(seq=7, utime=8)),
                ("ROBOT_STATE", 6_000_000, state(2**33 + 5, utime=10)),
            ]
        )
        found = [(c.topic, m.log_time, m.publish_time, m.sequence) for _, c, m, _ in self.mcap()]
        self.assertEqual(
            found,
            [
                ("/ROBOT_STATE", 5_000_000_000, 9000, 1),
                ("/REACH_STATUS", 4_000_000_000, 8000, 7),
                ("/ROBOT_STATE", 6_000_000_000, 10000, 5),
            ],
        )

    def test_numbers_that_json_does_not_have(self):
        self.write(
            [
                (
                    "REACH_STATUS",
                    1,
                    status(
                        staleness=float("inf"),
                        error=float("nan"),
                        utime=1,
                        state=3,
                        phase=-7,
                        samples=2**62 + 1,
                    ),
                )
            ]
        )
        ((_, _, _, found),) = self.mcap()
        self.assertEqual((found.staleness, found.samples), (float("inf"), 2**62 + 1))
        self.assertTrue(np.isnan(found.error))
        word = found.DESCRIPTOR.fields_by_name["state"].enum_type.values_by_number[found.state].name
        self.assertEqual((word, found.phase), ("HOLD", -7))

    def test_arrays_of_the_length_in_use(self):
        solved = filled(
            types.learner_prediction_t(),
            {
                "n_inputs": 2,
                "n_outputs": 1,
                "n_solutions": 2,
                "x_variance": [[0.5] * 8] * 16,
                "jacobian": [[[s + 0.1 * i for i in range(16)]] * 8 for s in range(16)],
            },
        )
        self.write(
            [
                ("ROBOT_STATE", 1, state(1, n=3)),
                ("ROBOT_STATE", 2, state(2, n=5)),
                ("ROBOT_STATE", 3, state(3, n=0)),
                ("ROBOT_STATE", 4, state(4, n=99)),
                ("ROBOT_STATE", 5, state(5, n=-4)),
                ("LEARNER_PREDICTION", 6, solved),
            ]
        )
        *states, prediction = (decoded for *_, decoded in self.mcap())
        self.assertEqual([len(found.position) for found in states], [3, 5, 0, 16, 0])
        self.assertEqual(list(states[1].position), state(2).position[:5])
        self.assertEqual([list(row.column) for row in prediction.x_variance], [[0.5], [0.5]])
        jacobian = [[list(inner.column) for inner in row.row] for row in prediction.jacobian]
        self.assertEqual(jacobian, [[[0, 0.1]], [[1, 1.1]]])

    def test_joints_images_and_configuration(self):
        config = types.config_t()
        config.text = [*b"period=0.02\ncaf", -61, -87, *[0] * (8192 - 17)]
        jpeg = bot_core.image_t.PIXEL_FORMAT_MJPEG
        self.write(
            [
                ("JOINT_STATE", 1, joint_state()),
                ("ROBOT_STATE", 2, state(1)),
                ("STEREO_IMAGES", 3, stereo(jpeg)),
                ("STEREO_IMAGES", 4, stereo(1)),
                ("REACH_CONFIG", 5, config),
            ]
        )
        found = self.mcap()
        topics = [channel.topic for _, channel, _, _ in found]
        self.assertEqual(
            topics,
            [
                "/JOINT_STATE",
                "/ROBOT_STATE",
                "/STEREO_IMAGES/left",
                "/STEREO_IMAGES/right",
                "/REACH_CONFIG",
            ],
        )
        self.assertEqual(list(found[0][3].joint_name), list(JOINTS))
        self.assertEqual(list(found[0][3].joint_position), [0, 0.25, 0.5])
        metadata = found[1][1].metadata
        self.assertEqual(json.loads(metadata["joints"]), list(JOINTS))
        self.assertEqual(json.loads(metadata["units"])["velocity"], "rad/s")
        image = found[2][3]
        self.assertEqual(
            (found[2][0].name, image.data, image.format, image.frame_id),
            ("foxglove.CompressedImage", b"jpeg", "jpeg", "left"),
        )
        self.assertEqual((image.timestamp.seconds, image.timestamp.nanos), (1, 500_000_000))
        self.assertEqual(found[4][3].text, "period=0.02\ncaf\\xc3\\xa9")
        self.assertIn("2 JPEG images", self.said)

    def test_a_file_that_is_there_stays_whole_until_the_new_one_is(self):
        path = self.folder / "run.mcap"
        path.write_bytes(b"of yesterday")
        self.write([("NOBODYS", 1, b"x")])
        self.assertIn("no message of ours", self.export("--mcap", path, code=1))
        self.assertEqual(path.read_bytes(), b"of yesterday")
        self.assertEqual({p.name for p in self.folder.iterdir()}, {"run.mcap", "run.lcmlog"})


if __name__ == "__main__":
    unittest.main()
