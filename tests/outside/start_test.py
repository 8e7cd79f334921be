"""An installed package runs a stranger's controller, with the same bits in one process and as a cluster."""
from outside import WAYS, OutsideTest


class Start(OutsideTest):
    def test_the_same_hash_in_one_process_and_as_a_cluster(self):
        file = self.experiment()
        hashes = {way: self.hash_of(self.run_experiment(file, *options)) for way, options in WAYS.items()}
        self.assertEqual(len(set(hashes.values())), 1, hashes)
