"""Options found from data: the threshold that gives a rate, the sensor that made a recording."""
