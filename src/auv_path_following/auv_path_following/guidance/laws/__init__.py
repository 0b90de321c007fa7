"""The guidance laws, one a file; `registered` lists them."""
