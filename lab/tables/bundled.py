"""The models of data/models as the gate meshes them: the records that the guard compares with (lab/records/bundled.jsonl)."""
from tables import models

PAGE = None
DATA = "data/models"
jobs, page, stored = models.jobs, models.page, models.stored
