"""reach-tune: parameters of the learner for samples of a user's own."""
