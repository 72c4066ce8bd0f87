"""Commands of the paper's method; `register_commands` names them, and each is imported when it is used."""
