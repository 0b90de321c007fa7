"""Better estimates near one: a servo, trims, and errors of the model."""
