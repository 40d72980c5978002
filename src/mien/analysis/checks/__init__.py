"""What an edit may break: one file a question, each measured frame by frame and body part by body part."""
