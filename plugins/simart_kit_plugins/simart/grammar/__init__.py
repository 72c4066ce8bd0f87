"""The grammar of answers: one script that writes training targets and that decodes nothing but valid ones."""
