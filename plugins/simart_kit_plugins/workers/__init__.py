"""Programs of others, run at arm's length: in their own python, for a limited time, and checked."""
