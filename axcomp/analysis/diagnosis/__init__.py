"""The diagnosis file of a volumetric compensation (manual 003, 3.5): all records that were read, as a spreadsheet.

``records`` reads the parameter files again, for a machine has forgotten which record came from where; ``workbook``
and ``files`` write what was found and need openpyxl.
"""
